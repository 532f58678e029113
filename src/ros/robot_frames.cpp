#include "ros/robot_frames.h"

#include <ros/console.h>
#include <tf2_eigen/tf2_eigen.h>

namespace dominant_plane_detection {
namespace {

constexpr double kLate = 0.05;  // [s] by which a transform may be older than an image

}  // namespace

std::string plainFrame(const std::string& frame) {
  return !frame.empty() && frame.front() == '/' ? frame.substr(1) : frame;
}

Pose findPose(const tf2::BufferCore& buffer, const std::string& target, const std::string& source,
              const ros::Time& stamp) {
  Pose pose;
  if (plainFrame(target) == plainFrame(source)) {
    pose.transform = Eigen::Isometry3d::Identity();
    pose.exact = true;
    return pose;
  }
  const auto look = [&](const ros::Time& time) {
    return buffer.lookupTransform(plainFrame(target), plainFrame(source), time);
  };
  const std::string problem = "No tf from " + target + " to " + source;
  try {
    pose.transform = tf2::transformToEigen(look(stamp));
    pose.exact = !stamp.isZero();  // that is the latest, whatever its time
    return pose;
  } catch (const tf2::ExtrapolationException& error) {
    pose.late = true;
    pose.problem = problem + " of the image's time: " + error.what();
  } catch (const std::exception& error) {
    pose.problem = problem + ": " + error.what();
    return pose;
  }
  try {
    const geometry_msgs::TransformStamped latest = look(ros::Time(0));
    const double late = stamp.toSec() - latest.header.stamp.toSec();
    if (late >= 0.0 && late <= kLate) {
      pose.transform = tf2::transformToEigen(latest);
      pose.late = false;
      pose.problem.clear();
    }
  } catch (const std::exception&) {
    // It has said why above.
  }
  return pose;
}

void RobotFrames::listen() {
  if (transforms_) return;
  // Not tf2's listener: what went out from here comes back, and tf2 warns of each that is known.
  const auto subscribe = [this](const char* topic, bool is_static) {
    constexpr std::uint32_t kQueue = 100;
    return node_.subscribe<tf2_msgs::TFMessage>(
        topic, kQueue, [this, is_static](const tf2_msgs::TFMessage::ConstPtr& message) {
          onTransforms(*message, is_static);
        });
  };
  transforms_ = subscribe("/tf", false);
  static_transforms_ = subscribe("/tf_static", true);
}

void RobotFrames::rest() {
  transforms_.shutdown();
  static_transforms_.shutdown();
}

void RobotFrames::onTransforms(const tf2_msgs::TFMessage& message, bool is_static) {
  const ros::Time now = ros::Time::now();
  if (now < last_message_) buffer_.clear();  // a recording begins again
  last_message_ = now;
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    try {
      if (!isOwn(transform)) buffer_.setTransform(transform, "tf", is_static);
    } catch (const tf2::TransformException& error) {
      ROS_WARN_STREAM_THROTTLE(5.0, "Dropped a transform from "
                                        << transform.header.frame_id << " to "
                                        << transform.child_frame_id << ": " << error.what());
    }
  }
}

/// @return whether it went out from here, and is known.
bool RobotFrames::isOwn(const geometry_msgs::TransformStamped& transform) const {
  const auto sent = sent_.find(plainFrame(transform.child_frame_id));
  return sent != sent_.end() && transform.header.frame_id == sent->second.header.frame_id &&
         transform.header.stamp <= sent->second.header.stamp;
}

Pose RobotFrames::pose(const std::string& target, const std::string& source,
                       const ros::Time& stamp) {
  if (plainFrame(target) != plainFrame(source)) listen();
  return findPose(buffer_, target, source, stamp);
}

std::string RobotFrames::parentOf(const std::string& frame) {
  listen();
  std::string parent;
  return buffer_._getParent(plainFrame(frame), ros::Time(0), parent) ? parent : "";
}

void RobotFrames::broadcast(const std::string& parent, const std::string& child,
                            const ros::Time& stamp, const Eigen::Isometry3d& transform) {
  if (!broadcaster_) broadcaster_ = std::make_unique<tf2_ros::TransformBroadcaster>();
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(transform);
  message.header.stamp = stamp;
  message.header.frame_id = plainFrame(parent);
  message.child_frame_id = plainFrame(child);
  broadcaster_->sendTransform(message);
  sent_[message.child_frame_id] = message;
  // Known here at once, for what else is made of this image.
  buffer_.setTransform(message, "dominant_plane_detection", false);
}

}  // namespace dominant_plane_detection
