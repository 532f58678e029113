#include "ros/ground_tf.h"

#include <ros/console.h>

#include "navigation/ground_frame.h"

namespace dominant_plane_detection {
namespace {

constexpr int kMostAncestors = 50;
/// [s] before anything goes out: until then what others publish has come, static frames among it.
constexpr double kPatience = 0.5;

}  // namespace

std::optional<std::string> GroundTf::publish(const std_msgs::Header& header,
                                             const Detection& detection) {
  if (conflict_ || !hasListened()) return std::nullopt;
  const Eigen::Isometry3d T_ground_optical =
      groundFromOptical(detection.normal, detection.distance);
  const bool base = parameters_.publish_tf == TfOutput::kBase;
  const bool went_out =
      base ? publishBase(header, T_ground_optical) : publishGround(header, T_ground_optical);
  if (!went_out) return std::nullopt;
  return base ? parameters_.base_frame : parameters_.ground_frame;
}

bool GroundTf::hasListened() {
  frames_.listen();
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (begin_.isZero()) begin_ = now;
  return (now - begin_).toSec() >= kPatience;
}

/// @param found the child's parent by tf.
bool GroundTf::isFree(const std::string& child, const std::string& parent,
                      const std::string& found) {
  // The image's frame may have become another one.
  const bool ours = found == plainFrame(parent) || parents_.count(found) != 0;
  return found.empty() || ours || refuse(child, parent, found);
}

bool GroundTf::refuse(const std::string& child, const std::string& parent,
                      const std::string& found) {
  conflict_ = true;
  ROS_ERROR_STREAM("No tf goes out from " << parent << " to " << child << ": tf has it below "
                                          << found
                                          << " already, and a frame has one parent. Give the "
                                             "parameter ground_frame another name, or set "
                                             "publish_tf to none.");
  return false;
}

bool GroundTf::publishGround(const std_msgs::Header& header,
                             const Eigen::Isometry3d& T_ground_optical) {
  const std::string& child = parameters_.ground_frame;
  if (!isFree(child, header.frame_id, frames_.parentOf(child))) return false;
  parents_.insert(plainFrame(header.frame_id));
  frames_.broadcast(header.frame_id, child, header.stamp, T_ground_optical.inverse());
  return true;
}

/// @param below_base becomes whether the base is among the frames above it.
std::string GroundTf::rootOf(const std::string& frame, bool& below_base) {
  std::string root = frame;
  below_base = false;
  for (int i = 0; i < kMostAncestors; ++i) {
    const std::string parent = frames_.parentOf(root);
    below_base = below_base || parent == plainFrame(parameters_.base_frame);
    if (parent.empty() || below_base) return root;
    root = parent;
  }
  return root;
}

bool GroundTf::publishBase(const std_msgs::Header& header,
                           const Eigen::Isometry3d& T_ground_optical) {
  bool below_base = false;
  const std::string root = rootOf(header.frame_id, below_base);
  const bool ours = roots_.count(root) != 0;
  if (below_base && !ours) return refuse(root, parameters_.base_frame, parameters_.base_frame);
  const Pose pose = frames_.pose(header.frame_id, root, header.stamp);
  if (!pose.transform || !isFree(root, parameters_.base_frame, frames_.parentOf(root)))
    return false;
  roots_.insert(root);
  frames_.broadcast(parameters_.base_frame, root, header.stamp, T_ground_optical * *pose.transform);
  return true;
}

}  // namespace dominant_plane_detection
