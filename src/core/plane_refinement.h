#pragma once

#include <cstddef>
#include <optional>

#include "core/tile_growth.h"
#include "core/tile_judge.h"

namespace dominant_plane_detection {

/// A plane fitted to a region by weighted least squares.
struct RefinedPlane {
  HessePlane plane;
  /// [-] in sigma(z): how far off the plane a tile's mean may be, given how the region scatters.
  float level;
  std::size_t fits = 0;  ///< [#] of steps that it took
};

/// Finds the one surface among a region's tiles, and fits its plane, weighted by 1 / sigma(z)^2 so
/// that far, noisy points do not lever it.
///
/// gamma has to be as wide as the sensor's worst error, so that a region may straddle two levels
/// and its plane lie on neither. Therefore the plane first moves to the densest heights, by weights
/// that become narrower step by step; then the scatter about it is measured where it is densest, by
/// the quarter of the points that is nearest to it, and what lies beyond four of its standard
/// deviations is left out. Where one surface is all there is, that changes nothing.
/// @return nothing if too few tiles determine a plane.
std::optional<RefinedPlane> refinePlane(const TileJudge& judge, const TileRegion& region);

/// The last part of it alone: the least squares plane of a region's tiles within a known level.
std::optional<RefinedPlane> fitPlane(const TileJudge& judge, const TileRegion& region,
                                     const HessePlane& start, float level);

}  // namespace dominant_plane_detection
