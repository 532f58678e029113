#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <string>

#include "core/ray_table.h"
#include "dominant_plane_detection/parameters.h"
#include "navigation/local_map.h"
#include "ros/detection_inputs.h"
#include "ros/node_parameters.h"
#include "ros/robot_frames.h"

namespace dominant_plane_detection {

/// The topic `~local_map`: with `odom_frame` a map that keeps, in that frame, what was seen;
/// otherwise one of each image alone, in the frame on the ground.
class MapOutput {
 public:
  /// @param rays shared with whoever needs those of the same images.
  MapOutput(ros::NodeHandle& private_node, const NodeParameters& parameters, RobotFrames& frames,
            RayTable& rays, const std::function<void()>& listeners_changed);

  bool anybodyListens() const { return publisher_.getNumSubscribers() > 0; }
  /// @return whether the frame on the ground has to go out for it.
  bool needsGroundFrame() const { return anybodyListens() && !keeps(); }
  /// With `odom_frame`: without a plane, or tf of the image's very time, nothing is added, and what
  /// is known of before goes out.
  /// @param ground_frame on the ground now (`GroundTf`).
  /// @param detector what the detection was made with.
  void publish(const DetectionInputs::Frame& frame, const Detection& detection,
               const std::optional<std::string>& ground_frame, const Parameters& detector);

 private:
  bool keeps() const { return !parameters_.odom_frame.empty(); }
  bool add(const DetectionInputs::Frame& frame, const Detection& detection,
           const Parameters& detector);
  std::optional<Eigen::Isometry3d> cameraInOdometry(const std_msgs::Header& header);
  void beginAnewAfterSilence(const ros::Time& stamp);

  NodeParameters parameters_;
  RobotFrames& frames_;
  RayTable& rays_;
  LocalMap map_;
  bool begun_ = false;             ///< something was added
  std::optional<ros::Time> last_;  ///< image, while somebody listened
  std::optional<ros::Time> lost_;  ///< the first image without tf since one that had it
  double height_ = 0.0;            ///< [m] of the ground in the frame of the map
  ros::Publisher publisher_;
};

}  // namespace dominant_plane_detection
