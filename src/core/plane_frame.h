#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/hesse_plane.h"

namespace dominant_plane_detection {

/// A plane as a point on it and three axes, the last of them its normal.
struct PlaneFrame {
  Eigen::Vector3f origin;  ///< [m]
  Eigen::Matrix3f axes;    ///< [-] orthonormal columns a, b, n

  /// @param centre [m] the origin is the plane's point nearest to it: near the points, heights are
  /// small numbers, for which float is enough.
  static PlaneFrame of(const HessePlane& plane, const Eigen::Vector3d& centre) {
    const Eigen::Vector3d& n = plane.normal;
    const Eigen::Vector3d a = n.unitOrthogonal();
    PlaneFrame frame;
    frame.origin = (centre - plane.signedDistance(centre) * n).cast<float>();
    frame.axes << a.cast<float>(), n.cross(a).cast<float>(), n.cast<float>();
    return frame;
  }
};

}  // namespace dominant_plane_detection
