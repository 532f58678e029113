#pragma once

#include <optional>

#include "openni2/camera_device.h"

namespace dominant_plane_detection {

/// What is asked of a camera's motor and light.
struct MotorOrders {
  std::optional<double> tilt;  ///< [rad] that the camera looks up
  std::optional<openni2_plugin::Led> led;

  bool empty() const { return !tilt && !led; }
};

/// Carries orders out. Of the session's thread.
class MotorControl {
 public:
  /// Another camera is open.
  void begin() { told_ = false; }
  /// What the camera does not do is said in the log; that it has no motor is said once.
  void follow(CameraDevice& camera, const MotorOrders& orders);

 private:
  bool told_ = false;  ///< that there is no motor
};

}  // namespace dominant_plane_detection
