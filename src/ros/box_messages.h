#pragma once

#include <dominant_plane_detection/ObstacleBoxArray.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <vector>

#include "navigation/obstacle_tracks.h"

namespace dominant_plane_detection {

/// @param T_optical_ground of the frame on the ground that the boxes are in.
ObstacleBoxArrayPtr boxesMessage(const std_msgs::Header& header,
                                 const std::vector<TrackedBox>& boxes,
                                 const Eigen::Isometry3d& T_optical_ground);

/// Each as a translucent cube, with its number, distance and height above it; they last a third of
/// a second.
visualization_msgs::MarkerArrayPtr boxMarkers(const std_msgs::Header& header,
                                              const std::vector<TrackedBox>& boxes,
                                              const Eigen::Isometry3d& T_optical_ground);

}  // namespace dominant_plane_detection
