#pragma once

#include <ros/node_handle.h>
#include <std_msgs/Float64.h>
#include <std_msgs/UInt16.h>

#include <functional>
#include <string>

#include "openni2_plugin/motor.h"

namespace dominant_plane_detection {

/// The topics of a Kinect's motor and light, as kinect_aux calls them, but in [rad] (REP 103).
class MotorTopics {
 public:
  /// What subscribers ask for; called in the node's queue, and must not wait.
  struct Orders {
    std::function<void(double angle)> tilt;  ///< [rad] that the camera is to look up
    std::function<void(openni2_plugin::Led)> led;
  };

  /// @param node topics are relative to it.
  /// @param listeners_changed called whenever somebody begins or ends to listen.
  void advertise(ros::NodeHandle node, Orders orders,
                 const std::function<void()>& listeners_changed);

  bool wanted() const { return angle_.getNumSubscribers() > 0; }
  /// @param angle [rad] that the camera looks up.
  void publish(double angle) const;

 private:
  void onTilt(const std_msgs::Float64& message) const;
  void onLed(const std_msgs::UInt16& message) const;

  Orders orders_;
  ros::Publisher angle_;
  std::string tilt_topic_, led_topic_;  ///< resolved
  ros::Subscriber tilt_, led_;
};

}  // namespace dominant_plane_detection
