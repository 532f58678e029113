#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/node_handle.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_broadcaster.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace dominant_plane_detection {

/// @return a frame's name as tf2 has it: old recordings have a slash before it.
std::string plainFrame(const std::string& frame);

/// A frame in another one.
struct Pose {
  std::optional<Eigen::Isometry3d> transform;  ///< T_target_source
  bool exact = false;   ///< of the very time, and not up to a twentieth of a second older
  bool late = false;    ///< there is none of the time, although the frames are known
  std::string problem;  ///< why there is none, in one sentence
};

/// What became of the images for which a frame was asked.
struct PoseCounts {
  std::size_t images = 0;   ///< [#]
  std::size_t missing = 0;  ///< [#] of them without
  std::size_t late = 0;     ///< [#] of these only because of the time

  void add(const Pose& pose) {
    ++images;
    if (pose.transform) return;
    ++missing;
    if (pose.late) ++late;
  }
};

/// Never waits.
Pose findPose(const tf2::BufferCore& buffer, const std::string& target, const std::string& source,
              const ros::Time& stamp);

/// tf as a detection needs it.
///
/// All of it happens in the thread of the node's callback queue, in which transforms come as well.
class RobotFrames {
 public:
  explicit RobotFrames(const ros::NodeHandle& node) : node_(node) {}

  /// Subscribes transforms; else that is done with the first call that needs them.
  void listen();
  /// Ends that; what is known stays.
  void rest();
  Pose pose(const std::string& target, const std::string& source, const ros::Time& stamp);
  /// @return empty where a frame has none, or is not known.
  std::string parentOf(const std::string& frame);

  /// @param transform T_parent_child
  void broadcast(const std::string& parent, const std::string& child, const ros::Time& stamp,
                 const Eigen::Isometry3d& transform);

 private:
  void onTransforms(const tf2_msgs::TFMessage& message, bool is_static);
  bool isOwn(const geometry_msgs::TransformStamped& transform) const;

  ros::NodeHandle node_;
  tf2::BufferCore buffer_;
  ros::Subscriber transforms_, static_transforms_;
  std::unique_ptr<tf2_ros::TransformBroadcaster> broadcaster_;
  /// The last transforms that went out, by child.
  std::map<std::string, geometry_msgs::TransformStamped> sent_;
  ros::Time last_message_;  ///< when transforms came
};

}  // namespace dominant_plane_detection
