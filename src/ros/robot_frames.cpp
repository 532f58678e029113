#include "ros/robot_frames.h"

#include <tf2_eigen/tf2_eigen.h>

namespace dominant_plane_detection {
namespace {

constexpr double kLate = 0.05;  // [s] by which a transform may be older than an image

}  // namespace

void RobotFrames::listen() {
  if (listener_) return;
  buffer_ = std::make_unique<tf2_ros::Buffer>();
  // Without a thread of its own: callbacks come in the node's queue.
  listener_ = std::make_unique<tf2_ros::TransformListener>(*buffer_, node_, false);
}

RobotFrames::Pose RobotFrames::pose(const std::string& target, const std::string& source,
                                    const ros::Time& stamp) {
  Pose pose;
  if (target == source) {
    pose.transform = Eigen::Isometry3d::Identity();
    pose.exact = true;
    return pose;
  }
  listen();
  const auto look = [&](const ros::Time& time) {
    return buffer_->lookupTransform(target, source, time);
  };
  try {
    pose.transform = tf2::transformToEigen(look(stamp));
    pose.exact = true;
    return pose;
  } catch (const tf2::ExtrapolationException& error) {
    pose.problem =
        "No tf from " + target + " to " + source + " of the image's time: " + error.what();
  } catch (const tf2::TransformException& error) {
    pose.problem = "No tf from " + target + " to " + source + ": " + error.what();
    return pose;
  }
  try {
    const geometry_msgs::TransformStamped latest = look(ros::Time(0));
    const double late = (stamp - latest.header.stamp).toSec();
    if (late >= 0.0 && late <= kLate) {
      pose.transform = tf2::transformToEigen(latest);
      pose.problem.clear();
    }
  } catch (const tf2::TransformException&) {
    // It has said why above.
  }
  return pose;
}

std::string RobotFrames::parentOf(const std::string& frame) {
  listen();
  std::string parent;
  return buffer_->_getParent(frame, ros::Time(0), parent) ? parent : "";
}

void RobotFrames::broadcast(const std::string& parent, const std::string& child,
                            const ros::Time& stamp, const Eigen::Isometry3d& transform) {
  if (!broadcaster_) broadcaster_ = std::make_unique<tf2_ros::TransformBroadcaster>();
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(transform);
  message.header.stamp = stamp;
  message.header.frame_id = parent;
  message.child_frame_id = child;
  broadcaster_->sendTransform(message);
}

}  // namespace dominant_plane_detection
