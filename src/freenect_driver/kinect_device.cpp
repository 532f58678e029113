#include "freenect_driver/kinect_device.h"

#include "freenect_driver/kinect_stream.h"
#include "openni2_plugin/property.h"

namespace dominant_plane_detection::freenect_driver {

using openni2_plugin::giveProperty;
using openni2_plugin::giveText;
using openni2_plugin::takeProperty;

namespace {

constexpr auto kNoSensor = static_cast<OniSensorType>(0);

}  // namespace

KinectDevice::KinectDevice(const KinectId& id, Driver driver)
    : serial_(id.serial), driver_(std::move(driver)), connection_(id, driver_.lost) {
  if (findDepthMode().is_valid != 0) {
    depth_modes_ = {{ONI_PIXEL_FORMAT_DEPTH_1_MM, kWidth, kHeight, 30},
                    {ONI_PIXEL_FORMAT_SHIFT_9_2, kWidth, kHeight, 30}};
  }
  if (findVideoMode(FREENECT_VIDEO_RGB, FREENECT_RESOLUTION_MEDIUM).is_valid != 0) {
    colour_modes_.push_back({ONI_PIXEL_FORMAT_RGB888, kWidth, kHeight, 30});
  }
  if (findVideoMode(FREENECT_VIDEO_RGB, FREENECT_RESOLUTION_HIGH).is_valid != 0) {
    colour_modes_.push_back({ONI_PIXEL_FORMAT_RGB888, 1280, 1024, 10});
  }
  if (findVideoMode(FREENECT_VIDEO_IR_10BIT, FREENECT_RESOLUTION_MEDIUM).is_valid != 0) {
    infrared_modes_.push_back({ONI_PIXEL_FORMAT_GRAY16, kWidth, kHeight, 30});
  }
  const auto add = [this](OniSensorType sensor, std::vector<OniVideoMode>& modes) {
    if (modes.empty()) return;
    sensors_.push_back({sensor, static_cast<int>(modes.size()), modes.data()});
  };
  add(ONI_SENSOR_DEPTH, depth_modes_);
  add(ONI_SENSOR_COLOR, colour_modes_);
  add(ONI_SENSOR_IR, infrared_modes_);
}

OniStatus KinectDevice::getSensorInfoList(OniSensorInfo** infos, int* count) {
  *infos = sensors_.data();
  *count = static_cast<int>(sensors_.size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* KinectDevice::createStream(OniSensorType sensor) {
  if (modes(sensor).empty()) return nullptr;
  return new KinectStream(*this, sensor);
}

void KinectDevice::destroyStream(oni::driver::StreamBase* stream) { delete stream; }

OniStatus KinectDevice::getProperty(int id, void* data, int* size) {
  switch (id) {
    case ONI_DEVICE_PROPERTY_SERIAL_NUMBER:
      return giveText(serial_, data, size);
    case ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION:
      return giveProperty(
          registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF, data,
          size);
    case openni2_plugin::kAcceleration: {
      const auto acceleration = connection_.acceleration();
      return acceleration ? giveProperty(*acceleration, data, size) : ONI_STATUS_ERROR;
    }
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus KinectDevice::setProperty(int id, const void* data, int size) {
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_SUPPORTED;
  OniImageRegistrationMode mode = ONI_IMAGE_REGISTRATION_OFF;
  const OniStatus status = takeProperty(mode, data, size);
  if (status != ONI_STATUS_OK) return status;
  if (isImageRegistrationModeSupported(mode) == FALSE) return ONI_STATUS_NOT_SUPPORTED;
  registered_ = mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  return ONI_STATUS_OK;
}

OniBool KinectDevice::isPropertySupported(int id) {
  if (id == openni2_plugin::kAcceleration) return connection_.hasAccelerometer() ? TRUE : FALSE;
  return id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER || id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
}

OniBool KinectDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  if (mode == ONI_IMAGE_REGISTRATION_OFF) return TRUE;
  return mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR && connection_.tables().registers();
}

const std::vector<OniVideoMode>& KinectDevice::modes(OniSensorType sensor) const {
  if (sensor == ONI_SENSOR_DEPTH) return depth_modes_;
  return sensor == ONI_SENSOR_COLOR ? colour_modes_ : infrared_modes_;
}

bool KinectDevice::begin(OniSensorType sensor) {
  if (sensor == ONI_SENSOR_DEPTH) return true;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (video_ != kNoSensor) {
    explain("colour and infrared come over one channel: only one of them can stream");
    return false;
  }
  video_ = sensor;
  return true;
}

void KinectDevice::end(OniSensorType sensor) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (video_ == sensor) video_ = kNoSensor;
}

}  // namespace dominant_plane_detection::freenect_driver
