#include "freenect_driver/kinect_stream.h"

#include <cstring>

#include "freenect_driver/optional_functions.h"

namespace dominant_plane_detection::freenect_driver {
namespace {

// libfreenect's infrared images are 8 rows higher than depth images: as many go above and below.
constexpr std::size_t kInfraredRows = 488;
constexpr std::size_t kRowsAbove = (kInfraredRows - kHeight) / 2;
// [px] at 640 columns, as the Kinect's makers and the ROS drivers have them.
constexpr double kDepthFocalLength = 575.8;
constexpr double kColourFocalLength = 525.0;

}  // namespace

KinectStream::KinectStream(KinectDevice& device, OniSensorType sensor)
    : PluginStream(sensor, device.modes(sensor)),
      device_(device),
      tables_(device.connection().tables()) {}

KinectStream::~KinectStream() { stop(); }

OniStatus KinectStream::start() {
  if (running_) return ONI_STATUS_OK;
  if (device_.connection().lost()) return ONI_STATUS_NO_DEVICE;
  if (!device_.beginStreaming(sensor())) return ONI_STATUS_OUT_OF_FLOW;
  running_ = startCamera();
  if (running_) return ONI_STATUS_OK;
  releaseFrame();
  device_.endStreaming(sensor());
  device_.explain("libfreenect does not start the stream");
  return ONI_STATUS_ERROR;
}

bool KinectStream::startCamera() {
  KinectConnection& connection = device_.connection();
  if (sensor() == ONI_SENSOR_DEPTH) return connection.startDepth(*this);
  const auto resolution =
      mode().resolutionX == kWidth ? FREENECT_RESOLUTION_MEDIUM : FREENECT_RESOLUTION_HIGH;
  if (sensor() == ONI_SENSOR_IR) {
    return connection.startVideo(FREENECT_VIDEO_IR_10BIT, resolution, *this);
  }
  if (!connection.startVideo(FREENECT_VIDEO_RGB, resolution, *this)) return false;
  // The camera forgets them when it stops.
  setSettings();
  return true;
}

void KinectStream::stop() {
  if (!running_) return;
  sensor() == ONI_SENSOR_DEPTH ? device_.connection().stopDepth()
                               : device_.connection().stopVideo();
  releaseFrame();
  device_.endStreaming(sensor());
  running_ = false;
}

void KinectStream::releaseFrame() {
  if (frame_ != nullptr) getServices().releaseFrame(frame_);
  frame_ = nullptr;
}

void* KinectStream::buffer() {
  frame_ = getServices().acquireFrame();
  const bool direct = sensor() != ONI_SENSOR_IR && frame_ != nullptr;
  if (direct) return frame_->data;
  // Without a frame the image is lost, but the camera has to write it somewhere.
  const auto width = static_cast<std::size_t>(mode().resolutionX);
  const auto height = static_cast<std::size_t>(mode().resolutionY) + kInfraredRows - kHeight;
  constexpr std::size_t kMostBytes = 3;  // of a pixel
  spare_.resize(width * height * kMostBytes);
  return spare_.data();
}

void KinectStream::finished(std::uint64_t time) {
  const int number = number_++;
  if (frame_ == nullptr) return;
  describe(number, time, *frame_);
  auto* const readings = static_cast<std::uint16_t*>(frame_->data);
  if (sensor() == ONI_SENSOR_DEPTH) convert(readings);
  if (sensor() == ONI_SENSOR_IR) {
    const auto step = static_cast<std::size_t>(frame_->stride);
    std::memcpy(frame_->data, spare_.data() + kRowsAbove * step, kHeight * step);
  }
  raiseNewFrame(frame_);
  releaseFrame();
}

void KinectStream::convert(std::uint16_t* readings) {
  if (mode().pixelFormat == ONI_PIXEL_FORMAT_SHIFT_9_2) return;
  device_.registered() ? tables_.toRegistered(readings) : tables_.toMillimetres(readings);
}

bool KinectStream::hasExposure() const { return optionalFunctions().set_exposure != nullptr; }

/// An exposure that is refused refuses nothing else.
bool KinectStream::onSetting(int id) {
  return !running_ || setSettings() || id != ONI_STREAM_PROPERTY_EXPOSURE;
}

bool KinectStream::setSettings() {
  KinectConnection& connection = device_.connection();
  connection.setFlag(FREENECT_AUTO_EXPOSURE, autoExposure());
  connection.setFlag(FREENECT_AUTO_WHITE_BALANCE, autoWhiteBalance());
  if (autoExposure() || exposure() <= 0 || connection.setExposure(exposure())) return true;
  device_.explain("libfreenect does not set the exposure");
  return false;
}

double KinectStream::focalLength(bool /*vertical*/) const {
  const double at_vga = sensor() == ONI_SENSOR_COLOR ? kColourFocalLength : kDepthFocalLength;
  return at_vga * mode().resolutionX / kWidth;
}

}  // namespace dominant_plane_detection::freenect_driver
