#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "openni2_plugin/driver_api.h"
#include "virtual_kinect/device_clock.h"
#include "virtual_kinect/scene_camera.h"
#include "virtual_kinect/virtual_kinect.h"

namespace dominant_plane_detection::virtual_kinect {

/// What a virtual device is made from.
struct DeviceDescription {
  std::string serial;
  Scene scene;
  double start = 0.0;  ///< [s] on the scene's camera path
  double drift = 0.0;  ///< [-] by which the clock is fast
};

/// An opened virtual Kinect: depth in mm and as raw disparity, colour, infrared.
class VirtualDevice : public oni::driver::DeviceBase {
 public:
  /// What the device leaves to its driver.
  struct Driver {
    std::function<void(double seconds)> unplug_after;
    std::function<void(double seconds)> replug_after;
    std::function<void(const std::string& text)> explain;  ///< why a call fails
  };

  VirtualDevice(const DeviceDescription& description, Driver driver);

  OniStatus getSensorInfoList(OniSensorInfo** infos, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;
  OniStatus invoke(int command, void* data, int size) override;
  OniBool isCommandSupported(int command) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

  // For its streams.
  const SceneCamera& camera() const { return camera_; }
  const DeviceClock& clock() const { return clock_; }
  const std::vector<OniVideoMode>& modes(OniSensorType sensor) const;
  DeviceClock::Steady::time_point begin() const { return begin_; }
  double sceneTime(DeviceClock::Steady::time_point time) const;
  bool registered() const { return registered_; }
  /// A stream that began at another number than the device has now is silent.
  int stalls() const { return stalls_; }
  bool gone() const { return gone_; }
  /// @return whether the sensor can stream beside those that do.
  bool begin(OniSensorType sensor);
  void end(OniSensorType sensor);
  void record(const FrameRecord& record);

  // For its driver.
  void unplug() { gone_ = true; }
  void stall() { ++stalls_; }

 private:
  OniStatus copyRecords(void* data, int* size) const;

  SceneCamera camera_;
  DeviceClock clock_;
  DeviceClock::Steady::time_point begin_;
  std::string serial_;
  double start_;
  Driver driver_;
  std::vector<OniVideoMode> depth_modes_, colour_modes_, infrared_modes_;
  std::vector<OniSensorInfo> sensors_;
  std::atomic<bool> registered_{false};
  std::atomic<bool> gone_{false};
  std::atomic<int> stalls_{0};
  mutable std::mutex mutex_;  ///< of what follows
  std::set<OniSensorType> streaming_;
  std::deque<FrameRecord> records_;
};

}  // namespace dominant_plane_detection::virtual_kinect
