#pragma once

#include <vector>

#include "core/tile_growth.h"
#include "core/tile_judge.h"

namespace dominant_plane_detection {

/// Tells a surface from the stripes along which a plane cuts through a room.
class SurfaceCheck {
 public:
  /// @param judge with the region's plane; all rows are judged.
  /// @return whether, of the tiles inside the region's convex hull in the image whose readings are
  /// not nearer than the plane, at least half lie on it. What is nearer may hide the surface; what
  /// is farther shows that it is not there.
  bool isSurface(TileJudge& judge, const TileRegion& region);

 private:
  void findHull(const TileMoments& tiles, const TileRegion& region);

  std::vector<double> left_;   ///< first column of the hull in each row of tiles, negated
  std::vector<double> right_;  ///< last one; both -infinity in rows that are outside
  std::vector<std::size_t> corners_;
};

}  // namespace dominant_plane_detection
