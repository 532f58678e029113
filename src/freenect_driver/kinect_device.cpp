#include "freenect_driver/kinect_device.h"

#include "freenect_driver/kinect_stream.h"

namespace dominant_plane_detection::freenect_driver {
namespace {

std::vector<OniVideoMode> depthModes() {
  if (findDepthMode().is_valid == 0) return {};
  return {{ONI_PIXEL_FORMAT_DEPTH_1_MM, kWidth, kHeight, 30},
          {ONI_PIXEL_FORMAT_SHIFT_9_2, kWidth, kHeight, 30}};
}

std::vector<OniVideoMode> colourModes() {
  std::vector<OniVideoMode> modes;
  if (findVideoMode(FREENECT_VIDEO_RGB, FREENECT_RESOLUTION_MEDIUM).is_valid != 0) {
    modes.push_back({ONI_PIXEL_FORMAT_RGB888, kWidth, kHeight, 30});
  }
  if (findVideoMode(FREENECT_VIDEO_RGB, FREENECT_RESOLUTION_HIGH).is_valid != 0) {
    modes.push_back({ONI_PIXEL_FORMAT_RGB888, 1280, 1024, 10});
  }
  return modes;
}

std::vector<OniVideoMode> infraredModes() {
  if (findVideoMode(FREENECT_VIDEO_IR_10BIT, FREENECT_RESOLUTION_MEDIUM).is_valid == 0) return {};
  return {{ONI_PIXEL_FORMAT_GRAY16, kWidth, kHeight, 30}};
}

}  // namespace

KinectDevice::KinectDevice(const KinectId& id, std::function<void()> lost,
                           std::function<void(const std::string& text)> explain)
    : PluginDevice(id.serial, std::move(explain)), connection_(id, std::move(lost)) {
  addSensor(ONI_SENSOR_DEPTH, depthModes());
  addSensor(ONI_SENSOR_COLOR, colourModes());
  addSensor(ONI_SENSOR_IR, infraredModes());
}

oni::driver::StreamBase* KinectDevice::createStream(OniSensorType sensor) {
  return modes(sensor).empty() ? nullptr : new KinectStream(*this, sensor);
}

}  // namespace dominant_plane_detection::freenect_driver
