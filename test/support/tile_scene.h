#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/growth_thresholds.h"
#include "core/hesse_plane.h"
#include "core/ray_table.h"
#include "core/tile_judge.h"
#include "core/tile_limits.h"
#include "core/tile_moments.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {

/// Paints a plane, n . r = d, on the pixels for which where(u, v).
template <typename Where>
void paintPlane(OwnedDepth<float>& depth, const CameraModel& camera, const HessePlane& plane,
                Where&& where) {
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      if (!where(u, v)) continue;
      const Eigen::Vector2d ray = camera.ray({u, v});
      depth.at(u, v) = static_cast<float>(plane.distance / plane.normal.dot(ray.homogeneous()));
    }
  }
}

/// Paints a plane on the tiles for which where(column, row).
template <typename Where>
void paintTiles(OwnedDepth<float>& depth, const CameraModel& camera, const HessePlane& plane,
                Where&& where) {
  paintPlane(depth, camera, plane,
             [&](int u, int v) { return where(u / kTileSize, v / kTileSize); });
}

/// Takes the readings from the tiles for which where(column, row).
template <typename Where>
void eraseTiles(OwnedDepth<float>& depth, Where&& where) {
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      if (where(u / kTileSize, v / kTileSize)) depth.at(u, v) = 0.0F;
    }
  }
}

/// Adds normally distributed errors along the rays to the readings.
/// @param sigma [m] of the depth [m].
template <typename Sigma>
void addNoise(OwnedDepth<float>& depth, Sigma&& sigma, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> gauss;
  for (float& z : depth.pixels) {
    const double error = gauss(generator) * sigma(static_cast<double>(z));
    if (z > 0.0F) z += static_cast<float>(error);
  }
}

/// @return the plane of all points as far as z in front of a camera.
inline HessePlane facing(double z) { return {{0.0, 0.0, 1.0}, z}; }

/// @return the same, turned about the image's column and row axes by small angles [rad].
inline HessePlane facing(double z, double about_column, double about_row) {
  const Eigen::Vector3d normal(std::tan(about_column), std::tan(about_row), 1.0);
  return HessePlane::through({0.0, 0.0, z}, normal.normalized());
}

/// @return [rad] between the normals.
inline double angleBetween(const HessePlane& a, const HessePlane& b) {
  return std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
}

/// The tiles of a depth image, their limits, and a judge of them.
struct TileScene {
  template <typename Pixel>
  TileScene(const OwnedDepth<Pixel>& depth, const CameraModel& camera,
            const GrowthThresholds& thresholds = growthThresholds(Parameters()))
      : tile_angle(kTileSize / std::max(camera.fx, camera.fy)) {
    RayTable rays;
    rays.build(camera);
    computeTileMoments(depth.view(), rays, 0.1F, 20.0F, tiles);
    limits.set(tiles, thresholds);
    judge.start(tiles, limits);
    taken.assign(tiles.count.size(), 0);
  }
  TileScene(const TileScene&) = delete;
  TileScene& operator=(const TileScene&) = delete;

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row * tiles.columns + column);
  }
  /// The judge looks at all tiles.
  void judgeBy(const HessePlane& plane, float level = std::numeric_limits<float>::infinity()) {
    judge.setPlane(plane, plane.distance * plane.normal, level);
    judge.judgeAll();
  }

  double tile_angle;  ///< [rad]
  TileMoments tiles;
  TileLimits limits;
  TileJudge judge;
  std::vector<std::uint8_t> taken;
};

}  // namespace dominant_plane_detection
