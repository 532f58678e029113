#include "openni2_plugin/plugin_device.h"

#include <cmath>

#include "openni2_plugin/property.h"

namespace dominant_plane_detection::openni2_plugin {

PluginDevice::PluginDevice(std::string serial, std::function<void(const std::string& text)> explain)
    : serial_(std::move(serial)), explain_(std::move(explain)) {}

void PluginDevice::addSensor(OniSensorType sensor, std::vector<OniVideoMode> modes) {
  if (modes.empty()) return;
  modes_.push_back(std::move(modes));
  sensors_.push_back({sensor, static_cast<int>(modes_.back().size()), modes_.back().data()});
}

OniStatus PluginDevice::getSensorInfoList(OniSensorInfo** infos, int* count) {
  *infos = sensors_.data();
  *count = static_cast<int>(sensors_.size());
  return ONI_STATUS_OK;
}

void PluginDevice::destroyStream(oni::driver::StreamBase* stream) { delete stream; }

OniStatus PluginDevice::getProperty(int id, void* data, int* size) {
  if (id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER) return giveText(serial_, data, size);
  if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) {
    return giveProperty(
        registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF, data,
        size);
  }
  if (id == kTiltAngle && hasMotor()) {
    const auto angle = tiltAngle();
    return angle ? giveProperty(*angle, data, size) : ONI_STATUS_ERROR;
  }
  if (id != kAcceleration || !hasAccelerometer()) return ONI_STATUS_NOT_SUPPORTED;
  const auto reading = acceleration();
  return reading ? giveProperty(*reading, data, size) : ONI_STATUS_ERROR;
}

OniStatus PluginDevice::setProperty(int id, const void* data, int size) {
  if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return setRegistration(data, size);
  const bool motor = id == kTiltAngle || id == kLed;
  return motor && hasMotor() ? setMotor(id, data, size) : ONI_STATUS_NOT_SUPPORTED;
}

OniStatus PluginDevice::setMotor(int id, const void* data, int size) {
  double angle = 0.0;
  Led led = Led::kOff;
  const OniStatus status =
      id == kTiltAngle ? takeProperty(angle, data, size) : takeProperty(led, data, size);
  if (status != ONI_STATUS_OK) return status;
  if (id == kTiltAngle && !(std::abs(angle) <= kMostTilt)) return ONI_STATUS_BAD_PARAMETER;
  return (id == kTiltAngle ? tilt(angle) : setLed(led)) ? ONI_STATUS_OK : ONI_STATUS_ERROR;
}

OniStatus PluginDevice::setRegistration(const void* data, int size) {
  OniImageRegistrationMode mode = ONI_IMAGE_REGISTRATION_OFF;
  const OniStatus status = takeProperty(mode, data, size);
  if (status != ONI_STATUS_OK) return status;
  if (isImageRegistrationModeSupported(mode) == FALSE) return ONI_STATUS_NOT_SUPPORTED;
  registered_ = mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  return ONI_STATUS_OK;
}

OniBool PluginDevice::isPropertySupported(int id) {
  if (id == kAcceleration) return hasAccelerometer() ? TRUE : FALSE;
  if (id == kTiltAngle || id == kLed) return hasMotor() ? TRUE : FALSE;
  return id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER || id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
}

OniBool PluginDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF ||
         (mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR && canRegister());
}

std::vector<OniVideoMode> PluginDevice::modes(OniSensorType sensor) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (sensors_[i].sensorType == sensor) return modes_[i];
  }
  return {};
}

bool PluginDevice::beginStreaming(OniSensorType sensor) {
  if (sensor == ONI_SENSOR_DEPTH) return true;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (video_) {
    explain("colour and infrared come over one channel: only one of them can stream");
    return false;
  }
  video_ = sensor;
  return true;
}

void PluginDevice::endStreaming(OniSensorType sensor) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (video_ == sensor) video_.reset();
}

}  // namespace dominant_plane_detection::openni2_plugin
