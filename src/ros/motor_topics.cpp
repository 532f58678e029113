#include "ros/motor_topics.h"

#include <ros/console.h>

#include <cmath>
#include <utility>

#include "ros/listeners.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

using openni2_plugin::kMostTilt;
using openni2_plugin::Led;

constexpr std::uint32_t kQueue = 1;  // only the newest order counts
constexpr double kSilence = 1.0;     // [s] after what was refused, in the log
constexpr double kDegree = M_PI / 180.0;

}  // namespace

void MotorTopics::advertise(ros::NodeHandle node, Orders orders,
                            const std::function<void()>& listeners_changed) {
  // Messages may come before the subscribers are there.
  orders_ = std::move(orders);
  tilt_topic_ = node.resolveName(topics::kTilt);
  led_topic_ = node.resolveName(topics::kLed);
  const auto changed = calledByPublishers(listeners_changed);
  angle_ = node.advertise<std_msgs::Float64>(topics::kTiltNow, kQueue, changed, changed);
  tilt_ = node.subscribe<std_msgs::Float64>(
      topics::kTilt, kQueue,
      [this](const std_msgs::Float64ConstPtr& message) { onTilt(*message); });
  led_ = node.subscribe<std_msgs::UInt16>(
      topics::kLed, kQueue, [this](const std_msgs::UInt16ConstPtr& message) { onLed(*message); });
}

void MotorTopics::publish(double angle) const {
  std_msgs::Float64 message;
  message.data = angle;
  angle_.publish(message);
}

void MotorTopics::onTilt(const std_msgs::Float64& message) const {
  const double angle = message.data;
  if (std::abs(angle) <= kMostTilt) return orders_.tilt(angle);
  ROS_ERROR_STREAM_THROTTLE(kSilence, "Refused " << tilt_topic_ << ": expected -" << kMostTilt
                                                 << " to " << kMostTilt << " rad, got " << angle
                                                 << ". Were degrees meant? That would be "
                                                 << angle * kDegree << " rad.");
}

void MotorTopics::onLed(const std_msgs::UInt16& message) const {
  if (message.data <= static_cast<int>(Led::kBlinkRedYellow)) {
    return orders_.led(static_cast<Led>(message.data));
  }
  ROS_ERROR_STREAM_THROTTLE(
      kSilence, "Refused " << led_topic_
                           << ": expected 0 off, 1 green, 2 red, 3 yellow, 4 or 5 blinking green, "
                              "6 blinking red and yellow, got "
                           << message.data << ".");
}

}  // namespace dominant_plane_detection
