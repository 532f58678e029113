#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "openni2_plugin/plugin_device.h"
#include "virtual_kinect/device_clock.h"
#include "virtual_kinect/scene_camera.h"
#include "virtual_kinect/virtual_kinect.h"
#include "virtual_kinect/virtual_uri.h"

namespace dominant_plane_detection::virtual_kinect {

/// What a virtual device is made from.
struct DeviceDescription {
  VirtualUri uri;
  Scene scene;
};

/// An opened virtual Kinect: depth in mm and as raw disparity, colour, infrared.
class VirtualDevice : public openni2_plugin::PluginDevice {
 public:
  /// What the device leaves to its driver.
  struct Driver {
    std::function<void(double seconds)> unplug_after;
    std::function<void(double seconds)> replug_after;
    std::function<void(const std::string& text)> explain;  ///< why a call fails
  };

  VirtualDevice(const DeviceDescription& description, Driver driver);

  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;
  OniStatus invoke(int command, void* data, int size) override;
  OniBool isCommandSupported(int command) override;

  // For its streams.
  const SceneCamera& camera() const { return camera_; }
  const DeviceClock& clock() const { return clock_; }
  DeviceClock::Steady::time_point begin() const { return begin_; }
  double sceneTime(DeviceClock::Steady::time_point time) const;
  /// A stream that began at another number than the device has now is silent.
  int stalls() const { return stalls_; }
  bool gone() const { return gone_; }
  bool starts(OniSensorType sensor) const { return refused_ != static_cast<int>(sensor); }
  /// @return [-] share of a frame that is sent.
  double sent() const { return uri_.sent; }
  void record(const FrameRecord& record);

  // For its driver.
  void unplug() { gone_ = true; }
  void stall() { ++stalls_; }

 private:
  bool canRegister() const override { return true; }
  bool hasAccelerometer() const override { return true; }
  std::optional<openni2_plugin::Acceleration> acceleration() override;
  bool hasMotor() const override { return true; }
  std::optional<double> tiltAngle() override { return camera_.tilt(); }
  bool tilt(double angle) override;
  bool setLed(openni2_plugin::Led led) override;
  OniStatus copyRecords(void* data, int* size) const;

  VirtualUri uri_;
  SceneCamera camera_;
  DeviceClock clock_;
  DeviceClock::Steady::time_point begin_;
  Driver driver_;
  std::atomic<bool> gone_{false};
  std::atomic<int> stalls_{0};
  std::atomic<openni2_plugin::Led> led_{openni2_plugin::Led::kBlinkGreen};
  std::atomic<int> refused_{0};  ///< sensor whose streams do not start; 0: none
  mutable std::mutex mutex_;     ///< of what follows
  std::deque<FrameRecord> records_;
};

}  // namespace dominant_plane_detection::virtual_kinect
