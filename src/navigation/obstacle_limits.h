#pragma once

namespace dominant_plane_detection {

/// What of the obstacles a robot would touch.
struct ObstacleLimits {
  double clearance_height = 0.0;     ///< [m] lower ones pass under it
  double max_obstacle_height = 2.0;  ///< [m] it passes under higher ones
};

/// @return [m] what is lower stands on the ground, as far as is seen of it.
inline double footHeight(const ObstacleLimits& limits) {
  constexpr double kFoot = 0.1, kAboveClearance = 0.03;  // [m]
  const double least = limits.clearance_height + kAboveClearance;
  return kFoot > least ? kFoot : least;
}

}  // namespace dominant_plane_detection
