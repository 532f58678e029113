#pragma once

namespace dominant_plane_detection {

/// What a robot would touch.
struct ObstacleLimits {
  double clearance_height = 0.0;     ///< [m] lower obstacles pass under it
  double max_obstacle_height = 2.0;  ///< [m] it passes under higher ones
  bool missing_ground = false;       ///< missing ground is an obstacle
  double range_max = 4.0;            ///< [m] farthest depth that was looked at
};

}  // namespace dominant_plane_detection
