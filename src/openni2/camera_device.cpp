#include "openni2/camera_device.h"

#include <OpenNI.h>

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
  return "";
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
  return settings;
}

std::string CameraDevice::apply(const CameraSettings& settings) {
  const auto registration = settings.depth_registration ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR
                                                        : openni::IMAGE_REGISTRATION_OFF;
  std::string problem;
  if (device_->isImageRegistrationModeSupported(registration) &&
      device_->setImageRegistrationMode(registration) != openni::STATUS_OK) {
    problem = std::string("depth_registration: the camera does not turn it ") +
              (settings.depth_registration ? "on" : "off") + ": " + lastOpenNi2Error();
  }
  if (has(StreamKind::kColour)) {
    stream(StreamKind::kColour).setAutomatic(settings.auto_exposure, settings.auto_white_balance);
  }
  openni::PlaybackControl* playback = device_->getPlaybackControl();
  if (playback != nullptr) playback->setRepeatEnabled(settings.repeat);
  return problem;
}

void CameraDevice::start(StreamKind kind, const CameraSettings& settings) {
  const VideoMode mode = isRecording() ? stream(kind).mode() : settings.mode(kind);
  const bool depth = kind == StreamKind::kDepth;
  stream(kind).start(mode, depth && settings.depth_registration, depth && settings.raw_disparity);
}

}  // namespace dominant_plane_detection
