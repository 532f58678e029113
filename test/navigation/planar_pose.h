#pragma once

#include <Eigen/Geometry>

namespace dominant_plane_detection {

/// @param x, y [m] @param yaw [rad]
inline Eigen::Isometry2d planarPose(double x, double y, double yaw) {
  Eigen::Isometry2d pose = Eigen::Isometry2d::Identity();
  pose.translation() = Eigen::Vector2d(x, y);
  pose.linear() = Eigen::Rotation2Dd(yaw).toRotationMatrix();
  return pose;
}

}  // namespace dominant_plane_detection
