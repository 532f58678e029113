#include "virtual_kinect/virtual_device.h"

#include <algorithm>

#include "openni2_plugin/property.h"
#include "virtual_kinect/virtual_stream.h"

namespace dominant_plane_detection::virtual_kinect {

using openni2_plugin::giveProperty;
using openni2_plugin::giveText;
using openni2_plugin::takeProperty;

namespace {

constexpr std::size_t kRecords = 256;

/// Every resolution in every format.
std::vector<OniVideoMode> modesOf(const std::vector<OniPixelFormat>& formats) {
  struct Resolution {
    int width, height, rate;
  };
  std::vector<OniVideoMode> modes;
  for (const Resolution& r : {Resolution{640, 480, 30}, {320, 240, 60}, {320, 240, 30}}) {
    for (const OniPixelFormat format : formats) {
      modes.push_back({format, r.width, r.height, r.rate});
    }
  }
  return modes;
}

}  // namespace

VirtualDevice::VirtualDevice(const DeviceDescription& description, Driver driver)
    : camera_(description.scene),
      clock_(description.drift),
      begin_(DeviceClock::Steady::now()),
      serial_(description.serial),
      start_(description.start),
      driver_(std::move(driver)),
      depth_modes_(modesOf({ONI_PIXEL_FORMAT_DEPTH_1_MM, ONI_PIXEL_FORMAT_SHIFT_9_2})),
      colour_modes_(modesOf({ONI_PIXEL_FORMAT_RGB888})),
      infrared_modes_(modesOf({ONI_PIXEL_FORMAT_GRAY16})) {
  const auto add = [this](OniSensorType sensor, std::vector<OniVideoMode>& modes) {
    sensors_.push_back({sensor, static_cast<int>(modes.size()), modes.data()});
  };
  add(ONI_SENSOR_DEPTH, depth_modes_);
  add(ONI_SENSOR_COLOR, colour_modes_);
  add(ONI_SENSOR_IR, infrared_modes_);
}

OniStatus VirtualDevice::getSensorInfoList(OniSensorInfo** infos, int* count) {
  *infos = sensors_.data();
  *count = static_cast<int>(sensors_.size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* VirtualDevice::createStream(OniSensorType sensor) {
  if (gone_) return nullptr;
  return new VirtualStream(*this, sensor);
}

void VirtualDevice::destroyStream(oni::driver::StreamBase* stream) { delete stream; }

OniStatus VirtualDevice::getProperty(int id, void* data, int* size) {
  switch (id) {
    case ONI_DEVICE_PROPERTY_SERIAL_NUMBER:
      return giveText(serial_, data, size);
    case ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION:
      return giveProperty(
          registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF, data,
          size);
    case kFrameRecords:
      return copyRecords(data, size);
    case openni2_plugin::kAcceleration:
      return giveProperty(camera_.acceleration(sceneTime(DeviceClock::Steady::now())), data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus VirtualDevice::setProperty(int id, const void* data, int size) {
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_SUPPORTED;
  OniImageRegistrationMode mode = ONI_IMAGE_REGISTRATION_OFF;
  const OniStatus status = takeProperty(mode, data, size);
  if (status == ONI_STATUS_OK) registered_ = mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  return status;
}

OniBool VirtualDevice::isPropertySupported(int id) {
  return id == ONI_DEVICE_PROPERTY_SERIAL_NUMBER || id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION ||
         id == kFrameRecords || id == openni2_plugin::kAcceleration;
}

OniStatus VirtualDevice::invoke(int command, void* data, int size) {
  if (command == kStall) {
    stall();
    return ONI_STATUS_OK;
  }
  if (!isCommandSupported(command)) return ONI_STATUS_NOT_SUPPORTED;
  double value = 0.0;
  if (takeProperty(value, data, size) != ONI_STATUS_OK) return ONI_STATUS_BAD_PARAMETER;
  if (command == kUnplug) driver_.unplug_after(value);
  if (command == kReplugAfter) driver_.replug_after(value);
  if (command == kDrift) clock_.setDrift(value);
  return ONI_STATUS_OK;
}

OniBool VirtualDevice::isCommandSupported(int command) {
  return command == kStall || command == kUnplug || command == kReplugAfter || command == kDrift;
}

OniBool VirtualDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF || mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
}

const std::vector<OniVideoMode>& VirtualDevice::modes(OniSensorType sensor) const {
  if (sensor == ONI_SENSOR_DEPTH) return depth_modes_;
  return sensor == ONI_SENSOR_COLOR ? colour_modes_ : infrared_modes_;
}

double VirtualDevice::sceneTime(DeviceClock::Steady::time_point time) const {
  const std::chrono::duration<double> passed = time - begin_;
  return camera_.sceneTime(start_ + passed.count());
}

bool VirtualDevice::begin(OniSensorType sensor) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const OniSensorType other = sensor == ONI_SENSOR_COLOR ? ONI_SENSOR_IR : ONI_SENSOR_COLOR;
  if (sensor != ONI_SENSOR_DEPTH && streaming_.count(other) != 0) {
    driver_.explain("colour and infrared come over one channel: only one of them can stream");
    return false;
  }
  streaming_.insert(sensor);
  return true;
}

void VirtualDevice::end(OniSensorType sensor) {
  const std::lock_guard<std::mutex> lock(mutex_);
  streaming_.erase(sensor);
}

void VirtualDevice::record(const FrameRecord& record) {
  const std::lock_guard<std::mutex> lock(mutex_);
  records_.push_back(record);
  if (records_.size() > kRecords) records_.pop_front();
}

OniStatus VirtualDevice::copyRecords(void* data, int* size) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::size_t count =
      std::min(static_cast<std::size_t>(*size) / sizeof(FrameRecord), records_.size());
  auto* to = static_cast<FrameRecord*>(data);
  std::copy(records_.end() - static_cast<std::ptrdiff_t>(count), records_.end(), to);
  *size = static_cast<int>(count * sizeof(FrameRecord));
  return ONI_STATUS_OK;
}

}  // namespace dominant_plane_detection::virtual_kinect
