#pragma once

#include <vector>

#include "core/tile_growth.h"
#include "core/tile_judge.h"

namespace dominant_plane_detection {

/// Tells a plane's surface from what only crosses or touches the plane.
class SurfaceCheck {
 public:
  /// @param judge with the region's plane; all rows are judged.
  /// @return whether the region is filled and flat.
  bool isSurface(TileJudge& judge, const TileRegion& region) {
    return isFilled(judge, region) && isFlat(judge, region);
  }

  /// Tells stripes along which a plane cuts through a room.
  /// @return whether, of the tiles inside the region's convex hull in the image whose readings are
  /// not nearer than the plane, at least half lie on it. What is nearer may hide the surface; what
  /// is farther shows that it is not there.
  bool isFilled(TileJudge& judge, const TileRegion& region);

  /// Tells a cap of a ball, or a fold of cloth.
  /// @return whether the planes of the region's left and right half in the image, and those of its
  /// upper and lower half, differ by less than 2 degrees, and as much as half of sigma(z) over the
  /// halves' widths can turn them. In recordings of floors they differ by 0.3 to 0.8 degrees.
  static bool isFlat(const TileJudge& judge, const TileRegion& region);

 private:
  void findHull(const TileMoments& tiles, const TileRegion& region);

  std::vector<double> left_;   ///< first column of the hull in each row of tiles, negated
  std::vector<double> right_;  ///< last one; both -infinity in rows that are outside
  std::vector<std::size_t> corners_;
};

}  // namespace dominant_plane_detection
