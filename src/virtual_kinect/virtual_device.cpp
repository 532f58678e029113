#include "virtual_kinect/virtual_device.h"

#include <algorithm>

#include "openni2_plugin/property.h"
#include "virtual_kinect/virtual_stream.h"

namespace dominant_plane_detection::virtual_kinect {

using openni2_plugin::giveProperty;
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
    : PluginDevice(description.uri.serial, driver.explain),
      uri_(description.uri),
      camera_(description.scene),
      clock_(description.uri.drift),
      begin_(DeviceClock::Steady::now()),
      driver_(std::move(driver)) {
  addSensor(ONI_SENSOR_DEPTH, modesOf({ONI_PIXEL_FORMAT_DEPTH_1_MM, ONI_PIXEL_FORMAT_SHIFT_9_2}));
  addSensor(ONI_SENSOR_COLOR, modesOf({ONI_PIXEL_FORMAT_RGB888}));
  addSensor(ONI_SENSOR_IR, modesOf({ONI_PIXEL_FORMAT_GRAY16}));
}

oni::driver::StreamBase* VirtualDevice::createStream(OniSensorType sensor) {
  if (gone_) return nullptr;
  return new VirtualStream(*this, sensor);
}

OniStatus VirtualDevice::getProperty(int id, void* data, int* size) {
  if (id == kFrameRecords) return copyRecords(data, size);
  if (id == openni2_plugin::kLed) return giveProperty(led_.load(), data, size);
  return PluginDevice::getProperty(id, data, size);
}

OniStatus VirtualDevice::setProperty(int id, const void* data, int size) {
  OniImageRegistrationMode mode = ONI_IMAGE_REGISTRATION_OFF;
  const bool on = id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION &&
                  takeProperty(mode, data, size) == ONI_STATUS_OK &&
                  mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  if (!on || uri_.registers) return PluginDevice::setProperty(id, data, size);
  explain("registration fails, as it was told to");
  return ONI_STATUS_ERROR;
}

OniBool VirtualDevice::isPropertySupported(int id) {
  return id == kFrameRecords ? TRUE : PluginDevice::isPropertySupported(id);
}

std::optional<openni2_plugin::Acceleration> VirtualDevice::acceleration() {
  return camera_.acceleration(sceneTime(DeviceClock::Steady::now()));
}

bool VirtualDevice::tilt(double angle) {
  camera_.setTilt(angle);
  return true;
}

bool VirtualDevice::setLed(openni2_plugin::Led led) {
  led_ = led;
  return true;
}

OniStatus VirtualDevice::invoke(int command, void* data, int size) {
  if (command == kStall) {
    stall();
    return ONI_STATUS_OK;
  }
  if (!isCommandSupported(command)) return ONI_STATUS_NOT_SUPPORTED;
  if (command == kRefuseStart) {
    std::int32_t sensor = 0;
    const OniStatus status = takeProperty(sensor, data, size);
    if (status == ONI_STATUS_OK) refused_ = sensor;
    return status;
  }
  double value = 0.0;
  if (takeProperty(value, data, size) != ONI_STATUS_OK) return ONI_STATUS_BAD_PARAMETER;
  if (command == kUnplug) driver_.unplug_after(value);
  if (command == kReplugAfter) driver_.replug_after(value);
  if (command == kDrift) clock_.setDrift(value);
  return ONI_STATUS_OK;
}

OniBool VirtualDevice::isCommandSupported(int command) {
  return command == kStall || command == kUnplug || command == kReplugAfter || command == kDrift ||
         command == kRefuseStart;
}

double VirtualDevice::sceneTime(DeviceClock::Steady::time_point time) const {
  const std::chrono::duration<double> passed = time - begin_;
  return camera_.sceneTime(uri_.start + passed.count());
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
