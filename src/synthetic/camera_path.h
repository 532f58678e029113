#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace dominant_plane_detection {

/// Where a camera is at a time. With all angles 0 it looks along x of the world (x forward, y left,
/// z up).
struct KeyPose {
  double time = 0.0;                                   ///< [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  double roll = 0.0;   ///< [rad] about the optical axis, > 0 turns the picture's right side down
  double pitch = 0.0;  ///< [rad] > 0 looks down
  double yaw = 0.0;    ///< [rad] > 0 looks left

  /// @return T_world_camera of the optical frame (x right, y down, z forward).
  Eigen::Isometry3d pose() const;
};

/// Key poses in the order of their times; in between a Catmull-Rom spline, smooth in velocity.
struct CameraPath {
  std::vector<KeyPose> keys;

  /// @return [s] the last key's time.
  double duration() const { return keys.empty() ? 0.0 : keys.back().time; }
  /// @param time [s] before the first and after the last key the camera stands still.
  /// @pre there is a key.
  KeyPose at(double time) const;
};

}  // namespace dominant_plane_detection
