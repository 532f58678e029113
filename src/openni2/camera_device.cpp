#include "openni2/camera_device.h"

#include <OpenNI.h>
#include <ros/console.h>

#include <algorithm>

namespace dominant_plane_detection {

CameraDevice::CameraDevice(std::shared_ptr<OpenNi2Runtime> runtime, const std::string& uri,
                           const FrameCallback& callback)
    : runtime_(std::move(runtime)), device_(runtime_->open(uri)) {
  const openni::DeviceInfo& info = device_->getDeviceInfo();
  description_ = {info.getUri(), info.getVendor(), info.getName(), serialNumber(*device_)};
  for (const StreamKind kind : kAllStreams) {
    if (!SensorStream::isIn(*device_, kind)) continue;
    streams_[static_cast<int>(kind)] = std::make_unique<SensorStream>(
        *device_, kind, [kind, callback](const SensorFrame& frame) { callback(kind, frame); });
  }
}

CameraDevice::~CameraDevice() {
  for (const auto& stream : streams_) {
    if (stream) stream->stop();
  }
  if (isRecording()) letPlayerRest();
  for (auto& stream : streams_) stream.reset();
  runtime_->close(std::move(device_));
}

bool CameraDevice::isRecording() const { return device_->isFile(); }

bool CameraDevice::hasMode(StreamKind kind, const CameraSettings& settings) const {
  if (isRecording()) return true;  // it plays what it has
  const bool raw = kind == StreamKind::kDepth && settings.raw_disparity;
  const std::vector<VideoMode> modes = stream(kind).modes(raw);
  return std::find(modes.begin(), modes.end(), settings.mode(kind)) != modes.end();
}

bool CameraDevice::hasAccelerometer() const {
  return device_->isPropertySupported(openni2_plugin::kAcceleration);
}

std::optional<openni2_plugin::Acceleration> CameraDevice::acceleration() const {
  openni2_plugin::Acceleration acceleration{};
  const auto status = device_->getProperty(openni2_plugin::kAcceleration, &acceleration);
  return status == openni::STATUS_OK ? std::make_optional(acceleration) : std::nullopt;
}

bool CameraDevice::hasMotor() const {
  return device_->isPropertySupported(openni2_plugin::kTiltAngle);
}

std::optional<double> CameraDevice::tiltAngle() const {
  double angle = 0.0;
  const auto status = device_->getProperty(openni2_plugin::kTiltAngle, &angle);
  return status == openni::STATUS_OK ? std::make_optional(angle) : std::nullopt;
}

bool CameraDevice::tilt(double angle) {
  return device_->setProperty(openni2_plugin::kTiltAngle, angle) == openni::STATUS_OK;
}

bool CameraDevice::setLed(openni2_plugin::Led led) {
  return device_->setProperty(openni2_plugin::kLed, led) == openni::STATUS_OK;
}

bool CameraDevice::canSet(int property) const {
  return has(StreamKind::kColour) && stream(StreamKind::kColour).canSet(property);
}

bool CameraDevice::canRegister() const {
  return device_->isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR);
}

std::string CameraDevice::refusal(const CameraSettings& settings) const {
  if (settings.raw_disparity && has(StreamKind::kDepth) &&
      stream(StreamKind::kDepth).modes(true).empty()) {
    return "raw_disparity: the camera streams depth in millimetres only";
  }
  for (const StreamKind kind : kAllStreams) {
    if (!has(kind) || hasMode(kind, settings)) continue;
    const bool raw = kind == StreamKind::kDepth && settings.raw_disparity;
    return std::string(toString(kind)) + "_mode: the camera does not have " +
           toString(settings.mode(kind)) + ", but " + toString(stream(kind).modes(raw));
  }
  if (settings.depth_registration && !canRegister()) {
    return "depth_registration: the camera cannot register depth to colour";
  }
  const auto unable = [](const char* name, bool able, int value) -> std::string {
    if (value == 0 || able) return "";
    return std::string(name) + ": the camera does not let it be set, got " + std::to_string(value) +
           ", expected 0, which leaves it to the camera";
  };
  const std::string problem = unable("exposure", hasExposure(), settings.exposure);
  return problem.empty() ? unable("gain", hasGain(), settings.gain) : problem;
}

CameraSettings CameraDevice::possible(CameraSettings settings) const {
  settings.raw_disparity = settings.raw_disparity && has(StreamKind::kDepth) &&
                           !stream(StreamKind::kDepth).modes(true).empty();
  for (const StreamKind kind : kAllStreams) {
    if (has(kind) && !hasMode(kind, settings)) {
      settings.mode(kind) = stream(kind).mode();
    }
  }
  settings.depth_registration = settings.depth_registration && canRegister();
  if (!hasExposure()) settings.exposure = 0;
  if (!hasGain()) settings.gain = 0;
  return settings;
}

std::string CameraDevice::apply(CameraSettings& settings) {
  std::string problem = applyRegistration(settings);
  const std::string colour = applyColour(settings);
  if (!problem.empty() && !colour.empty()) problem += "; ";
  openni::PlaybackControl* playback = device_->getPlaybackControl();
  if (playback != nullptr) playback->setRepeatEnabled(settings.repeat);
  return problem + colour;
}

std::string CameraDevice::applyRegistration(CameraSettings& settings) {
  const auto registration = settings.depth_registration ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR
                                                        : openni::IMAGE_REGISTRATION_OFF;
  if (!device_->isImageRegistrationModeSupported(registration) ||
      device_->setImageRegistrationMode(registration) == openni::STATUS_OK) {
    return "";
  }
  const std::string problem = std::string("depth_registration: the camera does not turn it ") +
                              (settings.depth_registration ? "on" : "off") + ": " +
                              lastOpenNi2Error();
  settings.depth_registration = false;
  return problem;
}

std::string CameraDevice::applyColour(CameraSettings& settings) {
  if (!has(StreamKind::kColour)) return "";
  SensorStream& colour = stream(StreamKind::kColour);
  colour.setAutomatic(settings.auto_exposure, settings.auto_white_balance);
  if (settings.auto_exposure) return "";
  const auto set = [&](const char* name, int property, int& value) -> std::string {
    if (value == 0 || colour.set(property, value)) return "";
    const std::string problem = std::string(name) + ": the camera refuses " +
                                std::to_string(value) + ": " + lastOpenNi2Error();
    value = 0;
    return problem;
  };
  const std::string problem = set("exposure", openni::STREAM_PROPERTY_EXPOSURE, settings.exposure);
  const std::string another = set("gain", openni::STREAM_PROPERTY_GAIN, settings.gain);
  return problem.empty() || another.empty() ? problem + another : problem + "; " + another;
}

void CameraDevice::start(StreamKind kind, const CameraSettings& settings) {
  const VideoMode mode = isRecording() ? stream(kind).mode() : settings.mode(kind);
  const bool depth = kind == StreamKind::kDepth;
  stream(kind).start(mode, depth && settings.depth_registration, depth && settings.raw_disparity);
  if (kind != StreamKind::kColour) return;
  // A camera may begin to stream with what it does by itself.
  CameraSettings again = settings;
  const std::string problem = applyColour(again);
  if (!problem.empty()) ROS_ERROR_STREAM(describe(description_) << ": " << problem << ".");
}

}  // namespace dominant_plane_detection
