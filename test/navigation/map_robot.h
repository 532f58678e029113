#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <set>
#include <utility>

#include "core/ray_table.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/parameters.h"
#include "dominant_plane_detection/prior.h"
#include "navigation/local_map.h"
#include "navigation/told_height.h"
#include "synthetic/camera_path.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {

// The robot that maps are made with, a Kinect 0.45 m up that looks down by 20 degrees, and its map.

constexpr double kCell = 0.05, kSize = 8.0, kMemory = 10.0;
constexpr double kCameraAhead = 0.1, kCameraHeight = 0.45;
constexpr double kTold = 0.05;  // [m]

inline Eigen::Isometry3d in3d(const Eigen::Isometry2d& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation().head<2>() = pose.translation();
  result.linear().topLeftCorner<2, 2>() = pose.linear();
  return result;
}

inline MapLimits limitsOf(const Parameters& parameters) {
  MapLimits limits;
  limits.noise = parameters.noise;
  limits.free_range = freeRange(parameters.local_error, kTold);
  return limits;
}

/// @return T_base_optical
inline Eigen::Isometry3d mountOfRobot() {
  return KeyPose{0.0, {kCameraAhead, 0.0, kCameraHeight}, 0.0, 20.0 * M_PI / 180.0, 0.0}.pose();
}

inline Prior priorOf(const Eigen::Isometry3d& mount) {
  Prior prior;
  prior.expected_up = mount.linear().transpose() * Eigen::Vector3d::UnitZ();
  prior.up_source = UpSource::kTf;
  prior.expected_height = Prior::ExpectedHeight{kCameraHeight, 0.125};
  return prior;
}

using WorldCell = std::pair<int, int>;
inline WorldCell cellOf(const Eigen::Vector2d& point) {
  return {static_cast<int>(std::floor(point.x() / kCell)),
          static_cast<int>(std::floor(point.y() / kCell))};
}

/// @return the cells of which an exact image shows floor.
inline std::set<WorldCell> floorCells(const Rendering& exact, const RayTable& rays,
                                      const Eigen::Isometry3d& camera, double free_range) {
  std::set<WorldCell> cells;
  for (int v = 0; v < exact.height; ++v) {
    for (int u = 0; u < exact.width; ++u) {
      const std::size_t i = static_cast<std::size_t>(v * exact.width + u);
      const double z = static_cast<double>(exact.depth[i]);
      const bool floor = exact.labels[i] == static_cast<std::uint8_t>(Label::kGround);
      if (!floor || !(z > 0.5 && z < free_range)) continue;
      const Eigen::Vector3d at = camera * (z * rays.ray(u, v).cast<double>());
      cells.insert(cellOf(at.head<2>()));
    }
  }
  return cells;
}

}  // namespace dominant_plane_detection
