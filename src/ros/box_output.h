#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/parameters.h"
#include "navigation/obstacle_boxes.h"
#include "navigation/obstacle_tracks.h"
#include "ros/detection_inputs.h"
#include "ros/node_parameters.h"
#include "ros/robot_frames.h"

namespace dominant_plane_detection {

/// The topics `~obstacle_boxes` and, for rviz, `~obstacle_box_markers`: obstacles as things, which
/// keep their identities by `odom_frame`, or, without one, as long as they move little from image
/// to image.
class BoxOutput {
 public:
  /// @param rays shared with whoever needs those of the same images.
  BoxOutput(ros::NodeHandle& private_node, const NodeParameters& parameters, RobotFrames& frames,
            RayTable& rays, const std::function<void()>& listeners_changed);

  bool anybodyListens() const {
    return boxes_.getNumSubscribers() > 0 || markers_.getNumSubscribers() > 0;
  }
  /// Without a plane there are none, which is said.
  /// @param detector what the detection was made with.
  void publish(const DetectionInputs::Frame& frame, const Detection& detection,
               const Parameters& detector);

 private:
  std::optional<Eigen::Isometry2d> groundInOdometry(const std_msgs::Header& header,
                                                    const Eigen::Isometry3d& T_ground_optical);
  void follow(const std_msgs::Header& header, const Eigen::Isometry3d& T_ground_optical,
              const std::vector<UprightBox>& found);

  NodeParameters parameters_;
  RobotFrames& frames_;
  RayTable& rays_;
  ObstacleBoxes finder_;
  ObstacleTracks tracks_;
  /// The last place of the frame on the ground by odometry; without one things are followed from
  /// image to image.
  std::optional<Eigen::Isometry2d> place_;
  ros::Time placed_;              ///< when that was
  std::vector<TrackedBox> told_;  ///< of the image
  ros::Publisher boxes_;
  ros::Publisher markers_;
};

}  // namespace dominant_plane_detection
