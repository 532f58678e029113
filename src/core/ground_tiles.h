#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/plane_refinement.h"
#include "core/tile_growth.h"

namespace dominant_plane_detection {

/// From a region to all tiles that are ground.
///
/// The region's rim are the tiles that touch its plane (see `TileVerdict`) and hang together with
/// it: noisier than what decides about the plane, but ground. Pieces are what hangs together in the
/// same way beyond gaps wider than delta: floor behind an obstacle that stands from one side of the
/// view to the other. A piece joins if it is large enough, if there is a seed of its own in it,
/// most of nine neighbouring tiles on the plane, and if the plane fitted to its points on the plane
/// is the same: their normals differ by less than 25 degrees, and as much as a step of sigma(z)
/// over the piece's width can turn it. That width is what tells a small piece of floor from the
/// stripe of a wall at its height.
class GroundTiles {
 public:
  struct Limits {
    bool join_pieces;
    std::size_t min_piece;  ///< [px]
  };

  /// @param tile_angle see `TileGrowth`.
  void start(const TileMoments& tiles, double tile_angle) { growth_.start(tiles, tile_angle); }

  /// @param judge with the region's plane.
  /// @param region tiles of it that lie on the plane; what else lies on it and hangs together with
  /// them is added.
  /// @param other not 0 for tiles of other surfaces, padded like the moments.
  void collect(TileJudge& judge, TileRegion& region, const Limits& limits,
               const std::vector<std::uint8_t>& other);

  /// The same for those of some tiles that lie on a surface's plane.
  /// @param judge is left with that plane.
  /// @param region becomes them, and what is added.
  /// @return whether there are any.
  bool collectSurface(TileJudge& judge, const SurfacePlane& surface,
                      const std::vector<std::size_t>& tiles, const Limits& limits,
                      const std::vector<std::uint8_t>& other, TileRegion& region);

  /// @return 1 for the tiles of region, rim and pieces, padded like the moments.
  const std::vector<std::uint8_t>& ground() const { return ground_; }
  /// @return the tiles on the plane in the pieces that join.
  const std::vector<std::size_t>& pieces() const { return pieces_; }

 private:
  TileGrowth growth_;
  std::vector<std::uint8_t> ground_;
  std::vector<std::uint8_t> seen_;      ///< not 0 for tiles that were looked at
  std::vector<std::size_t> beginning_;  ///< of what hangs together
  std::vector<std::size_t> pieces_;
};

}  // namespace dominant_plane_detection
