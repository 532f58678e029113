#include "virtual_kinect/virtual_stream.h"

#include <pthread.h>

#include <cmath>

#include "openni2_plugin/modes.h"
#include "openni2_plugin/property.h"

namespace dominant_plane_detection::virtual_kinect {

using openni2_plugin::bytesPerPixel;
using openni2_plugin::describeFrame;
using openni2_plugin::giveProperty;
using openni2_plugin::sameMode;
using openni2_plugin::takeProperty;

namespace {

constexpr int kMaxDepth = 10000;  // [mm]

template <typename Clock>
std::int64_t nanoseconds() {
  return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
}

}  // namespace

VirtualStream::VirtualStream(VirtualDevice& device, OniSensorType sensor)
    : device_(device), sensor_(sensor), mode_(device.modes(sensor).front()) {}

VirtualStream::~VirtualStream() { stop(); }

OniStatus VirtualStream::start() {
  if (thread_.joinable()) return ONI_STATUS_OK;
  if (device_.gone()) return ONI_STATUS_NO_DEVICE;
  if (!device_.begin(sensor_)) return ONI_STATUS_OUT_OF_FLOW;
  stopping_ = false;
  thread_ = std::thread([this] { run(); });
  return ONI_STATUS_OK;
}

void VirtualStream::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  stopping_changed_.notify_all();
  thread_.join();
  device_.end(sensor_);
}

void VirtualStream::run() {
  pthread_setname_np(pthread_self(), "virtual_kinect");
  const auto period =
      std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(1.0 / mode_.fps));
  const int stalls = device_.stalls();
  // All streams of a device expose at multiples of their period, so that depth and colour agree.
  auto number = (Steady::now() - device_.begin()) / period + 1;
  for (;;) {
    const Steady::time_point due = device_.begin() + number * period;
    OniFrame* frame = getServices().acquireFrame();
    if (frame == nullptr) return;
    FrameRecord record{};
    record.scene_time = device_.sceneTime(due);
    record.frame_number = static_cast<std::uint32_t>(number);
    record.registered = device_.registered() ? 1 : 0;
    render(record.scene_time, record.frame_number, *frame);
    const bool running = sleepUntil(due);
    if (running && stalls == device_.stalls() && !device_.gone()) {
      describeFrame(sensor_, mode_, static_cast<int>(number),
                    static_cast<std::uint64_t>(device_.clock().at(due)), *frame);
      record.timestamp = frame->timestamp;
      record.address = reinterpret_cast<std::uint64_t>(frame->data);
      record.raised = nanoseconds<Steady>();
      // Late frames were exposed when they were due all the same.
      record.exposed = nanoseconds<std::chrono::system_clock>() -
                       std::chrono::nanoseconds(Steady::now() - due).count();
      if (sensor_ == ONI_SENSOR_DEPTH) device_.record(record);
      raiseNewFrame(frame);
    }
    getServices().releaseFrame(frame);
    if (!running) return;
    number = std::max(number + 1, (Steady::now() - device_.begin()) / period);
  }
}

bool VirtualStream::sleepUntil(Steady::time_point time) {
  std::unique_lock<std::mutex> lock(mutex_);
  return !stopping_changed_.wait_until(lock, time, [this] { return stopping_; });
}

void VirtualStream::render(double scene_time, std::uint32_t frame, OniFrame& to) const {
  const SceneCamera& camera = device_.camera();
  const int width = mode_.resolutionX;
  const int height = mode_.resolutionY;
  auto* readings = static_cast<std::uint16_t*>(to.data);
  if (sensor_ == ONI_SENSOR_COLOR) {
    camera.colour(scene_time, width, height, static_cast<std::uint8_t*>(to.data));
  } else if (sensor_ == ONI_SENSOR_IR) {
    camera.infrared(scene_time, width, height, readings);
  } else if (mode_.pixelFormat == ONI_PIXEL_FORMAT_SHIFT_9_2) {
    camera.disparity(scene_time, width, height, frame, readings);
  } else {
    camera.depth(scene_time, device_.registered(), width, height, frame, readings);
  }
}

OniStatus VirtualStream::getProperty(int id, void* data, int* size) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return giveProperty(mode_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return giveProperty(fieldOfView(false), data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return giveProperty(fieldOfView(true), data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return giveProperty(sensor_ == ONI_SENSOR_DEPTH ? kMaxDepth : 0, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return giveProperty(0, data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return giveProperty(bytesPerPixel(mode_.pixelFormat) * mode_.resolutionX, data, size);
    case ONI_STREAM_PROPERTY_CROPPING:
      // OpenNI2's player shows no frame of a recording that does not say how it is cropped.
      return giveProperty(OniCropping{}, data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return giveProperty(OniBool{FALSE}, data, size);
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return giveProperty(auto_exposure_, data, size);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return giveProperty(auto_white_balance_, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus VirtualStream::setProperty(int id, const void* data, int size) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return setMode(data, size);
    case ONI_STREAM_PROPERTY_MIRRORING: {
      OniBool mirrored = FALSE;
      const OniStatus status = takeProperty(mirrored, data, size);
      return status == ONI_STATUS_OK && mirrored != FALSE ? ONI_STATUS_NOT_SUPPORTED : status;
    }
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return setSwitch(auto_exposure_, data, size);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return setSwitch(auto_white_balance_, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus VirtualStream::setMode(const void* data, int size) {
  OniVideoMode wanted{};
  const OniStatus status = takeProperty(wanted, data, size);
  if (status != ONI_STATUS_OK) return status;
  if (thread_.joinable()) return ONI_STATUS_OUT_OF_FLOW;
  for (const OniVideoMode& mode : device_.modes(sensor_)) {
    if (!sameMode(mode, wanted)) continue;
    mode_ = mode;
    return ONI_STATUS_OK;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus VirtualStream::setSwitch(OniBool& value, const void* data, int size) const {
  return sensor_ == ONI_SENSOR_COLOR ? takeProperty(value, data, size) : ONI_STATUS_NOT_SUPPORTED;
}

OniBool VirtualStream::isPropertySupported(int id) {
  const bool colour =
      id == ONI_STREAM_PROPERTY_AUTO_EXPOSURE || id == ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE;
  return colour ? sensor_ == ONI_SENSOR_COLOR
                : id >= ONI_STREAM_PROPERTY_CROPPING && id <= ONI_STREAM_PROPERTY_MIRRORING;
}

float VirtualStream::fieldOfView(bool vertical) const {
  const CameraModel camera = device_.camera().camera(mode_.resolutionX, mode_.resolutionY);
  return static_cast<float>(vertical ? 2.0 * std::atan(0.5 * camera.height / camera.fy)
                                     : 2.0 * std::atan(0.5 * camera.width / camera.fx));
}

}  // namespace dominant_plane_detection::virtual_kinect
