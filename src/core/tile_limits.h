#pragma once

#include <vector>

#include "core/growth_thresholds.h"
#include "core/tile_moments.h"

namespace dominant_plane_detection {

/// A tile with fewer readings [#] has no plane of its own; an eighth of them, so that a floor may
/// be full of holes.
constexpr float kMinReadings = 0.125F * kTileSize * kTileSize;

/// The thresholds of section III.B for each tile, of its depth; padded like the moments.
struct TileLimits {
  std::vector<float> delta;          ///< [m]
  std::vector<float> epsilon2;       ///< [m^2]
  std::vector<float> gamma;          ///< [m]
  std::vector<float> inverse_sigma;  ///< [1/m]
  std::vector<float> radius;         ///< [m] half the extent of the tile's points

  void set(const TileMoments& tiles, const GrowthThresholds& thresholds);
};

/// @return whether the points of two tiles come closer than delta, as if they were spread evenly
/// about their centres.
inline bool closerThanDelta(const TileMoments& tiles, const TileLimits& limits, std::size_t tile,
                            std::size_t other) {
  const float reach = limits.delta[tile] + limits.radius[tile] + limits.radius[other];
  const float dx = tiles.x[tile] - tiles.x[other];
  const float dy = tiles.y[tile] - tiles.y[other];
  const float dz = tiles.z[tile] - tiles.z[other];
  return dx * dx + dy * dy + dz * dz < reach * reach;
}

}  // namespace dominant_plane_detection
