#pragma once

#include <functional>
#include <string>

#include "freenect_driver/kinect_connection.h"
#include "openni2_plugin/plugin_device.h"

namespace dominant_plane_detection::freenect_driver {

/// An opened Kinect v1 as OpenNI2 sees it: depth in mm and as raw disparity, colour, infrared.
class KinectDevice : public openni2_plugin::PluginDevice {
 public:
  /// @param lost see KinectConnection.
  /// @throw std::runtime_error when it cannot be opened.
  KinectDevice(const KinectId& id, std::function<void()> lost,
               std::function<void(const std::string& text)> explain);

  oni::driver::StreamBase* createStream(OniSensorType sensor) override;

  /// For its streams.
  KinectConnection& connection() { return connection_; }

 private:
  bool canRegister() const override { return connection_.tables().registers(); }
  bool hasAccelerometer() const override { return connection_.hasAccelerometer(); }
  std::optional<openni2_plugin::Acceleration> acceleration() override {
    return connection_.acceleration();
  }
  bool hasMotor() const override { return connection_.hasMotor(); }
  std::optional<double> tiltAngle() override { return connection_.tiltAngle(); }
  bool tilt(double angle) override { return connection_.tilt(angle); }
  bool setLed(openni2_plugin::Led led) override { return connection_.setLed(led); }

  KinectConnection connection_;
};

}  // namespace dominant_plane_detection::freenect_driver
