#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace dominant_plane_detection {

/// The frame on the ground that belongs to a camera: below it on the plane, z up, x along the
/// viewing direction (REP 103).
/// @param normal [-] unit, from the plane to the camera, in the optical frame.
/// @param distance [m] of the camera from the plane.
/// @return T_ground_optical. Within a degree of straight down, x is where the image's upper side
/// is.
inline Eigen::Isometry3d groundFromOptical(const Eigen::Vector3d& normal, double distance) {
  constexpr double kDown = 0.0175;  // [rad]
  const Eigen::Vector3d view = Eigen::Vector3d::UnitZ();
  const bool down = normal.cross(view).norm() < kDown;
  const Eigen::Vector3d ahead = down ? Eigen::Vector3d(-Eigen::Vector3d::UnitY()) : view;
  const Eigen::Vector3d x = (ahead - ahead.dot(normal) * normal).normalized();
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear().row(0) = x;
  transform.linear().row(1) = normal.cross(x);
  transform.linear().row(2) = normal;
  transform.translation().z() = distance;
  return transform;
}

/// The same frame as seen from above, in a frame with z up.
/// @param T_world_optical of the camera.
/// @return T_world_ground in x, y and yaw.
inline Eigen::Isometry2d groundFromAbove(const Eigen::Isometry3d& T_world_optical,
                                         const Eigen::Isometry3d& T_ground_optical) {
  const Eigen::Isometry3d ground = T_world_optical * T_ground_optical.inverse();
  const Eigen::Vector3d x = ground.linear().col(0);
  Eigen::Isometry2d pose = Eigen::Isometry2d::Identity();
  pose.translation() = ground.translation().head<2>();
  pose.linear() = Eigen::Rotation2Dd(std::atan2(x.y(), x.x())).toRotationMatrix();
  return pose;
}

}  // namespace dominant_plane_detection
