#pragma once

#include <cstddef>
#include <optional>

#include "core/tile_growth.h"
#include "core/tile_judge.h"

namespace dominant_plane_detection {

/// The plane of the one surface among a region's tiles.
struct SurfacePlane {
  HessePlane plane;
  /// [-] in sigma(z): how far off the plane a tile's mean may be, given how the region scatters.
  float level;
  std::size_t fits;  ///< [#] of steps that it took
};

/// Finds the one surface among a region's tiles.
///
/// gamma has to be as wide as the sensor's worst error, so that a region may straddle two levels
/// and its plane lie on neither. Therefore planes through three of its tiles compete for the
/// densest heights first, and the best moves there by narrow weights; then the scatter about it is
/// measured where it is densest, by the quarter of the points that is nearest to it. What lies
/// beyond three of its standard deviations is not of this surface. Where one surface is all there
/// is, that leaves nothing out.
/// @return nothing if too few tiles determine a plane.
std::optional<SurfacePlane> findSurface(const TileJudge& judge, const TileRegion& region);

/// Fits a plane to a region's tiles by least squares, weighted by 1 / sigma(z)^2 so that far, noisy
/// points do not lever it.
/// @param start near the solution; tiles off it by more than gamma or `level` sigma(z) do not
/// count.
/// @return nothing if too few tiles determine a plane.
std::optional<SurfacePlane> fitPlane(const TileJudge& judge, const TileRegion& region,
                                     const HessePlane& start, float level);

}  // namespace dominant_plane_detection
