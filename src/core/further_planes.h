#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/ground_tiles.h"
#include "core/plane_refinement.h"
#include "core/surface_check.h"
#include "core/tile_growth.h"
#include "core/tile_judge.h"
#include "core/tile_limits.h"

namespace dominant_plane_detection {

/// A plane with the tiles of its surface.
struct TilePlane {
  HessePlane plane;
  std::size_t points = 0;           ///< [px]
  std::vector<std::uint8_t> tiles;  ///< 1 for them and their rim, padded like the moments
};

/// Finds the planes beside the dominant one, in whatever direction: what the same growth finds that
/// is flat. epsilon is half as large again: all of the depth's error is along the normal of a wall
/// that faces the camera, but only a part of it along a floor's.
///
/// Seeds are so close to each other that a square of the smallest size has four, at most every
/// fourth tile of every fourth row; a surface that was found is no part of another one.
class FurtherPlanes {
 public:
  /// What is looked for.
  struct Limits {
    std::size_t min_points;  ///< [px] in tiles that lie on the plane: without the surface's rim
    GrowthThresholds thresholds;  ///< of the dominant plane
    GroundTiles::Limits pieces;
  };

  /// @param tile_angle see `TileGrowth`.
  /// @param dominant 1 for the tiles of the dominant plane, padded like the moments.
  /// @return largest first, by the points of their tiles; valid until the next call.
  const std::vector<TilePlane>& find(const TileMoments& tiles, double tile_angle,
                                     const std::vector<std::uint8_t>& dominant,
                                     const Limits& wanted);
  /// @return of the tiles of the last call.
  const TileLimits& limits() const { return limits_; }

 private:
  void tryRegion(std::size_t seed, const Limits& wanted);

  TileLimits limits_;
  TileJudge judge_;
  TileGrowth growth_;
  GroundTiles ground_tiles_;
  TileRegion region_;
  std::vector<std::uint8_t> taken_;  ///< 1 for tiles of planes that were found
  std::vector<std::uint8_t> tried_;  ///< 1 for tiles of regions that were grown: no further seeds
  std::size_t joined_ = 0;           ///< [#] tiles of all regions that were grown
  std::vector<TilePlane> planes_;
};

}  // namespace dominant_plane_detection
