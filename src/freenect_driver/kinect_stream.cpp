#include "freenect_driver/kinect_stream.h"

#include <cmath>
#include <cstring>

#include "openni2_plugin/modes.h"
#include "openni2_plugin/property.h"

namespace dominant_plane_detection::freenect_driver {

using openni2_plugin::bytesPerPixel;
using openni2_plugin::describeFrame;
using openni2_plugin::giveProperty;
using openni2_plugin::sameMode;
using openni2_plugin::takeProperty;

namespace {

constexpr int kMaxDepth = 10000;  // [mm]
// libfreenect's infrared images are 8 rows higher than depth images: as many go above and below.
constexpr std::size_t kInfraredRows = 488;
constexpr std::size_t kRowsAbove = (kInfraredRows - kHeight) / 2;
// [px] at 640 columns, as the Kinect's makers and the ROS drivers have them.
constexpr double kDepthFocalLength = 575.8;
constexpr double kColourFocalLength = 525.0;

}  // namespace

KinectStream::KinectStream(KinectDevice& device, OniSensorType sensor)
    : device_(device),
      sensor_(sensor),
      mode_(device.modes(sensor).front()),
      tables_(device.connection().tables()) {}

KinectStream::~KinectStream() { stop(); }

OniStatus KinectStream::start() {
  if (running_) return ONI_STATUS_OK;
  if (device_.connection().lost()) return ONI_STATUS_NO_DEVICE;
  if (!device_.begin(sensor_)) return ONI_STATUS_OUT_OF_FLOW;
  running_ = startCamera();
  if (running_) return ONI_STATUS_OK;
  releaseFrame();
  device_.end(sensor_);
  device_.explain("libfreenect does not start the stream");
  return ONI_STATUS_ERROR;
}

bool KinectStream::startCamera() {
  KinectConnection& connection = device_.connection();
  if (sensor_ == ONI_SENSOR_DEPTH) return connection.startDepth(*this);
  const auto resolution =
      mode_.resolutionX == kWidth ? FREENECT_RESOLUTION_MEDIUM : FREENECT_RESOLUTION_HIGH;
  if (sensor_ == ONI_SENSOR_IR) {
    return connection.startVideo(FREENECT_VIDEO_IR_10BIT, resolution, *this);
  }
  if (!connection.startVideo(FREENECT_VIDEO_RGB, resolution, *this)) return false;
  // The camera forgets them when it stops.
  connection.setFlag(FREENECT_AUTO_EXPOSURE, auto_exposure_ != FALSE);
  connection.setFlag(FREENECT_AUTO_WHITE_BALANCE, auto_white_balance_ != FALSE);
  return true;
}

void KinectStream::stop() {
  if (!running_) return;
  sensor_ == ONI_SENSOR_DEPTH ? device_.connection().stopDepth() : device_.connection().stopVideo();
  releaseFrame();
  device_.end(sensor_);
  running_ = false;
}

void KinectStream::releaseFrame() {
  if (frame_ != nullptr) getServices().releaseFrame(frame_);
  frame_ = nullptr;
}

void* KinectStream::buffer() {
  frame_ = getServices().acquireFrame();
  const bool direct = sensor_ != ONI_SENSOR_IR && frame_ != nullptr;
  if (direct) return frame_->data;
  // Without a frame the image is lost, but the camera has to write it somewhere.
  const auto width = static_cast<std::size_t>(mode_.resolutionX);
  const auto height = static_cast<std::size_t>(mode_.resolutionY) + kInfraredRows - kHeight;
  spare_.resize(width * height * static_cast<std::size_t>(bytesPerPixel(mode_.pixelFormat)));
  return spare_.data();
}

void KinectStream::finished(std::uint64_t time) {
  const int number = number_++;
  if (frame_ == nullptr) return;
  describeFrame(sensor_, mode_, number, time, *frame_);
  auto* const readings = static_cast<std::uint16_t*>(frame_->data);
  if (sensor_ == ONI_SENSOR_DEPTH) convert(readings);
  if (sensor_ == ONI_SENSOR_IR) {
    const auto step = static_cast<std::size_t>(frame_->stride);
    std::memcpy(frame_->data, spare_.data() + kRowsAbove * step, kHeight * step);
  }
  raiseNewFrame(frame_);
  releaseFrame();
}

void KinectStream::convert(std::uint16_t* readings) {
  if (mode_.pixelFormat == ONI_PIXEL_FORMAT_SHIFT_9_2) return;
  device_.registered() ? tables_.toRegistered(readings) : tables_.toMillimetres(readings);
}

OniStatus KinectStream::getProperty(int id, void* data, int* size) {
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

OniStatus KinectStream::setProperty(int id, const void* data, int size) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return setMode(data, size);
    case ONI_STREAM_PROPERTY_MIRRORING: {
      OniBool mirrored = FALSE;
      const OniStatus status = takeProperty(mirrored, data, size);
      return status == ONI_STATUS_OK && mirrored != FALSE ? ONI_STATUS_NOT_SUPPORTED : status;
    }
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return setSwitch(FREENECT_AUTO_EXPOSURE, auto_exposure_, data, size);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return setSwitch(FREENECT_AUTO_WHITE_BALANCE, auto_white_balance_, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus KinectStream::setMode(const void* data, int size) {
  OniVideoMode wanted{};
  const OniStatus status = takeProperty(wanted, data, size);
  if (status != ONI_STATUS_OK) return status;
  if (running_) return ONI_STATUS_OUT_OF_FLOW;
  for (const OniVideoMode& mode : device_.modes(sensor_)) {
    if (!sameMode(mode, wanted)) continue;
    mode_ = mode;
    return ONI_STATUS_OK;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus KinectStream::setSwitch(freenect_flag flag, OniBool& value, const void* data, int size) {
  const OniStatus status = takeProperty(value, data, size);
  if (status == ONI_STATUS_OK && running_) device_.connection().setFlag(flag, value != FALSE);
  return status;
}

OniBool KinectStream::isPropertySupported(int id) {
  const bool colour =
      id == ONI_STREAM_PROPERTY_AUTO_EXPOSURE || id == ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE;
  return colour ? sensor_ == ONI_SENSOR_COLOR
                : id >= ONI_STREAM_PROPERTY_CROPPING && id <= ONI_STREAM_PROPERTY_MIRRORING;
}

float KinectStream::fieldOfView(bool vertical) const {
  const double focal = (sensor_ == ONI_SENSOR_COLOR ? kColourFocalLength : kDepthFocalLength) *
                       mode_.resolutionX / kWidth;
  const int size = vertical ? mode_.resolutionY : mode_.resolutionX;
  return static_cast<float>(2.0 * std::atan(0.5 * size / focal));
}

}  // namespace dominant_plane_detection::freenect_driver
