#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace dominant_plane_detection {

/// @return [rad] 0 to pi, between two directions of any length; right for small ones, too.
inline double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace dominant_plane_detection
