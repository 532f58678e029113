#include "openni2/motor_control.h"

#include <ros/console.h>

#include <utility>

namespace dominant_plane_detection {

void MotorControl::follow(CameraDevice& camera, const MotorOrders& orders) {
  if (orders.empty()) return;
  const std::string name = describe(camera.description());
  if (!camera.hasMotor()) {
    if (std::exchange(told_, true)) return;
    ROS_ERROR_STREAM(name << ": it has no motor and no light, or does not let them be used: "
                             "tilt_angle and led_option do nothing.");
    return;
  }
  if (orders.tilt && !camera.tilt(*orders.tilt)) {
    ROS_ERROR_STREAM(name << ": it does not tilt to " << *orders.tilt
                          << " rad: " << lastOpenNi2Error() << ".");
  }
  if (orders.led && !camera.setLed(*orders.led)) {
    ROS_ERROR_STREAM(name << ": its light does not follow: " << lastOpenNi2Error() << ".");
  }
}

}  // namespace dominant_plane_detection
