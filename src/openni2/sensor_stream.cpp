#include "openni2/sensor_stream.h"

#include <PS1080.h>
#include <ros/console.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include "openni2/lasting_threads.h"
#include "openni2/runtime.h"

namespace dominant_plane_detection {
namespace {

openni::SensorType sensorType(StreamKind kind) {
  if (kind == StreamKind::kDepth) return openni::SENSOR_DEPTH;
  return kind == StreamKind::kColour ? openni::SENSOR_COLOR : openni::SENSOR_IR;
}

/// @return the encoding of a pixel format that is published, empty for one that is not.
std::string encoding(openni::PixelFormat format) {
  namespace encodings = sensor_msgs::image_encodings;
  switch (format) {
    case openni::PIXEL_FORMAT_DEPTH_1_MM:
    case openni::PIXEL_FORMAT_SHIFT_9_2:
      return encodings::TYPE_16UC1;
    case openni::PIXEL_FORMAT_RGB888:
      return encodings::RGB8;
    case openni::PIXEL_FORMAT_GRAY16:
      return encodings::MONO16;
    case openni::PIXEL_FORMAT_GRAY8:
      return encodings::MONO8;
    default:
      return "";
  }
}

bool isWanted(openni::PixelFormat format, bool raw) {
  return !encoding(format).empty() && raw == (format == openni::PIXEL_FORMAT_SHIFT_9_2);
}

VideoMode toMode(const openni::VideoMode& mode) {
  return {mode.getResolutionX(), mode.getResolutionY(), mode.getFps()};
}

/// @return [byte] that an image of the frame's size has.
std::size_t imageBytes(const openni::VideoFrameRef& frame) {
  return static_cast<std::size_t>(frame.getStrideInBytes()) *
         static_cast<std::size_t>(frame.getHeight());
}

/// @return [byte] that the device has sent of it.
std::size_t sentBytes(const openni::VideoFrameRef& frame) {
  return static_cast<std::size_t>(std::max(frame.getDataSize(), 0));
}

std::int64_t steadyNanoseconds() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

const char* toString(StreamKind kind) {
  if (kind == StreamKind::kDepth) return "depth";
  return kind == StreamKind::kColour ? "rgb" : "ir";
}

/// Lets OpenNI2 write frames into messages.
class SensorStream::Allocator : public openni::VideoStream::FrameAllocator {
 public:
  void* allocateFrameBuffer(int size) override { return pool.lend(static_cast<std::size_t>(size)); }
  void freeFrameBuffer(void* data) override { pool.giveBack(data); }

  ImagePool pool;
};

bool SensorStream::isIn(openni::Device& device, StreamKind kind) {
  return device.hasSensor(sensorType(kind));
}

SensorStream::SensorStream(openni::Device& device, StreamKind kind, Callback callback)
    : kind_(kind), callback_(std::move(callback)) {
  if (stream_.create(device, sensorType(kind)) != openni::STATUS_OK) {
    throw std::runtime_error(std::string("no ") + toString(kind) +
                             " stream: " + lastOpenNi2Error());
  }
  if (stream_.isPropertySupported(openni::STREAM_PROPERTY_MIRRORING)) {
    stream_.setMirroringEnabled(false);
  }
  allocator_ = std::make_unique<Allocator>();
  stream_.setFrameBuffersAllocator(allocator_.get());
  // By the C interface: the listener of the C++ one calls OpenNI2 in the stream's own thread, which
  // ends with the stream; see lasting_threads.h.
  oniStreamRegisterNewFrameCallback(
      stream_._getHandle(),
      [](OniStreamHandle, void* cookie) {
        auto* const stream = static_cast<SensorStream*>(cookie);
        const std::lock_guard<std::mutex> lock(stream->mutex_);
        stream->arrived_ = true;
        stream->changed_.notify_one();
      },
      this, &listener_);
  delivery_ = runInLastingThread([this] { deliverFrames(); });
}

SensorStream::~SensorStream() {
  stop();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  delivery_.wait();
  oniStreamUnregisterNewFrameCallback(stream_._getHandle(), listener_);
  // The sensor may be in other hands as well, and go on with our memory: then it is left to it.
  const bool taken_back = stream_.setFrameBuffersAllocator(nullptr) == openni::STATUS_OK;
  stream_.destroy();
  if (!taken_back || allocator_->pool.lent()) static_cast<void>(allocator_.release());
}

std::vector<VideoMode> SensorStream::modes(bool raw) const {
  std::vector<VideoMode> modes;
  const auto& infos = stream_.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < infos.getSize(); ++i) {
    const VideoMode mode = toMode(infos[i]);
    if (!isWanted(infos[i].getPixelFormat(), raw)) continue;
    if (std::find(modes.begin(), modes.end(), mode) == modes.end()) modes.push_back(mode);
  }
  return modes;
}

VideoMode SensorStream::mode() const { return toMode(stream_.getVideoMode()); }

double SensorStream::horizontalFieldOfView() const {
  return static_cast<double>(stream_.getHorizontalFieldOfView());
}

double SensorStream::baseline() const {
  double centimetres = 0.0;
  const bool told = stream_.getProperty(XN_STREAM_PROPERTY_EMITTER_DCMOS_DISTANCE, &centimetres) ==
                    openni::STATUS_OK;
  return told ? 0.01 * centimetres : 0.0;
}

void SensorStream::setMode(const VideoMode& mode, bool raw) {
  const auto current = stream_.getVideoMode();
  if (toMode(current) == mode && isWanted(current.getPixelFormat(), raw)) return;
  const auto& infos = stream_.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < infos.getSize(); ++i) {
    if (!(toMode(infos[i]) == mode) || !isWanted(infos[i].getPixelFormat(), raw)) continue;
    if (stream_.setVideoMode(infos[i]) == openni::STATUS_OK) return;
    throw std::runtime_error(toString(mode) + " is refused: " + lastOpenNi2Error());
  }
  throw std::runtime_error("there is no mode " + toString(mode) + (raw ? " with" : " without") +
                           " raw disparity, but " + toString(modes(raw)));
}

void SensorStream::start(const VideoMode& mode, bool registered, bool raw) {
  setMode(mode, raw);
  registered_ = registered;
  last_sign_ = steadyNanoseconds();
  heard_ = false;
  running_ = true;
  if (stream_.start() == openni::STATUS_OK) return;
  running_ = false;
  throw std::runtime_error(lastOpenNi2Error());
}

void SensorStream::stop() {
  if (!running_) return;
  {
    const std::lock_guard<std::mutex> lock(delivering_);
    running_ = false;
  }
  stream_.stop();
}

double SensorStream::silence() const {
  return 1e-9 * static_cast<double>(steadyNanoseconds() - last_sign_);
}

void SensorStream::setAutomatic(bool exposure, bool white_balance) {
  openni::CameraSettings* settings = stream_.getCameraSettings();
  if (settings == nullptr) return;
  settings->setAutoExposureEnabled(exposure);
  settings->setAutoWhiteBalanceEnabled(white_balance);
}

void SensorStream::deliverFrames() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ending_ || arrived_; });
    if (ending_) return;
    arrived_ = false;
    lock.unlock();
    try {
      deliver();
    } catch (const std::exception& error) {
      ROS_ERROR_STREAM_THROTTLE(5.0, "Lost a " << toString(kind_) << " image: " << error.what());
    }
    lock.lock();
  }
}

/// Hands the newest frame to the callback, if there is one and the stream runs.
void SensorStream::deliver() {
  const std::lock_guard<std::mutex> lock(delivering_);
  if (!running_) return;
  openni::VideoFrameRef frame;
  if (!read(frame)) return;
  last_sign_ = steadyNanoseconds();
  heard_ = true;
  if (allocator_->pool.takenBytes() > ImagePool::kMostTaken) {
    // Left out: the numbers of the frames tell that it is missing.
    ROS_WARN_STREAM_THROTTLE(5.0, "Subscribers in this process keep "
                                      << allocator_->pool.takenBytes() / 1000000 << " MB of "
                                      << toString(kind_)
                                      << " images; no more are published until they let go.");
    return;
  }
  SensorFrame sensor_frame;
  sensor_frame.image = message(frame);
  sensor_frame.device_time = frame.getTimestamp();
  sensor_frame.number = frame.getFrameIndex();
  sensor_frame.rate = frame.getVideoMode().getFps();
  sensor_frame.registered = registered_;
  sensor_frame.raw = frame.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_SHIFT_9_2;
  sensor_frame.incomplete = sentBytes(frame) < imageBytes(frame);
  frame.release();  // the message keeps the memory
  callback_(sensor_frame);
}

bool SensorStream::read(openni::VideoFrameRef& frame) {
  openni::VideoStream* streams[] = {&stream_};
  int ready = 0;
  return openni::OpenNI::waitForAnyStream(streams, 1, &ready, 0) == openni::STATUS_OK &&
         stream_.readFrame(&frame) == openni::STATUS_OK && frame.isValid();
}

sensor_msgs::ImagePtr SensorStream::message(const openni::VideoFrameRef& frame) {
  const std::size_t bytes = imageBytes(frame), sent = std::min(sentBytes(frame), bytes);
  sensor_msgs::ImagePtr image;
  if (sent == bytes) image = allocator_->pool.take(frame.getData());
  if (!image) {
    // Somebody else in this process streams the same sensor into memory of their own; or there is
    // less than an image, and what an earlier one left behind it is in the driver's memory.
    image = allocator_->pool.make(bytes);
    std::memcpy(image->data.data(), frame.getData(), sent);
    std::fill(image->data.begin() + static_cast<std::ptrdiff_t>(sent), image->data.end(), 0);
  }
  image->data.resize(bytes);  // OpenNI2 may have asked for more than the frame has
  image->width = static_cast<std::uint32_t>(frame.getWidth());
  image->height = static_cast<std::uint32_t>(frame.getHeight());
  image->step = static_cast<std::uint32_t>(frame.getStrideInBytes());
  image->encoding = encoding(frame.getVideoMode().getPixelFormat());
  image->is_bigendian = 0;
  return image;
}

}  // namespace dominant_plane_detection
