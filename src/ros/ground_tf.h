#pragma once

#include <ros/time.h>

#include <optional>
#include <set>
#include <string>

#include "dominant_plane_detection/detection.h"
#include "ros/node_parameters.h"
#include "ros/robot_frames.h"

namespace dominant_plane_detection {

/// The transform that a plane makes: below the camera, z up, x along the viewing direction.
///
/// A frame has one parent. Where somebody else gives one to the frame that would go out, nothing
/// does, and the log says once who it is.
class GroundTf {
 public:
  GroundTf(const NodeParameters& parameters, RobotFrames& frames)
      : parameters_(parameters), frames_(frames) {}

  /// @return whether it goes out with every plane, whoever listens.
  bool always() const { return parameters_.publish_tf != TfOutput::kNone && !conflict_; }
  /// Broadcasts the ground of a plane.
  /// @return the frame that is on the ground now; nothing where it cannot go out.
  /// @pre detection.found()
  std::optional<std::string> publish(const std_msgs::Header& header, const Detection& detection);

 private:
  bool hasListened();
  bool publishGround(const std_msgs::Header& header, const Eigen::Isometry3d& T_ground_optical);
  bool publishBase(const std_msgs::Header& header, const Eigen::Isometry3d& T_ground_optical);
  bool isFree(const std::string& child, const std::string& parent, const std::string& found);
  bool refuse(const std::string& child, const std::string& parent, const std::string& found);
  std::string rootOf(const std::string& frame, bool& below_base);

  NodeParameters parameters_;
  RobotFrames& frames_;
  std::set<std::string> parents_;  ///< that the ground went out below
  std::set<std::string> roots_;    ///< of cameras' frames that went out below the base
  ros::SteadyTime begin_;          ///< of listening to what is there
  /// Somebody else publishes the transform: for good, as both would flicker.
  bool conflict_ = false;
};

}  // namespace dominant_plane_detection
