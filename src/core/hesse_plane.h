#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>

namespace dominant_plane_detection {

/// A plane in Hesse normal form, n . r = d (Eq. 4), with the paper's orientation: the normal points
/// away from the camera, d >= 0. The published plane is the same with the opposite normal.
struct HessePlane {
  Eigen::Vector3d normal = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< [m] from the origin

  /// @param centre [m] r_g, a point of the plane; d = n . r_g (Eq. 7).
  /// @param unit_normal [-] of either sign; turned so that d >= 0.
  static HessePlane through(const Eigen::Vector3d& centre, const Eigen::Vector3d& unit_normal) {
    const double distance = unit_normal.dot(centre);
    return distance < 0.0 ? HessePlane{-unit_normal, -distance} : HessePlane{unit_normal, distance};
  }

  /// @return [m] n . r - d (Eq. 4): negative on the camera's side.
  double signedDistance(const Eigen::Vector3d& point) const { return normal.dot(point) - distance; }
};

/// @return columns that turn (p, q, c) into a change of [normal, distance]: the normal by p and q
/// along two axes across it, the distance by c. Its transpose takes the change apart again.
inline Eigen::Matrix<double, 4, 3> planeChanges(const Eigen::Vector3d& normal) {
  Eigen::Matrix<double, 4, 3> changes = Eigen::Matrix<double, 4, 3>::Zero();
  const Eigen::Vector3d axis = normal.unitOrthogonal();
  changes.block<3, 1>(0, 0) = axis;
  changes.block<3, 1>(0, 1) = normal.cross(axis);
  changes(3, 2) = 1.0;
  return changes;
}

}  // namespace dominant_plane_detection
