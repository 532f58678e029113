#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/tile_growth.h"

namespace dominant_plane_detection {

/// Joins the pieces of a region's plane that lie beyond gaps wider than delta: floor behind an
/// obstacle that stands from one side of the view to the other.
///
/// A piece joins if it is grown from a seed of its own on the region's plane by the same three
/// thresholds, is large enough, and if the plane fitted to its own points is the same: their
/// normals differ by less than 25 degrees, and as much as a step of sigma(z) over the piece's width
/// can turn it. That width is what tells a small piece of floor from the stripe of a wall at its
/// height.
class PieceJoining {
 public:
  struct Piece {
    std::size_t points;  ///< [px]
    std::size_t begin;   ///< of its tiles among those that joined
    std::size_t end;
  };

  void start(const TileMoments& tiles, double tile_angle);

  /// @param judge with the region's plane.
  /// @param taken 1 for tiles of other regions and of this one; those that join are added.
  /// @param min_points [px]
  /// @param joined the tiles that joined are added.
  /// @return the pieces that joined.
  const std::vector<Piece>& join(TileJudge& judge, const HessePlane& plane, std::size_t min_points,
                                 std::vector<std::uint8_t>& taken,
                                 std::vector<std::size_t>& joined);

 private:
  TileGrowth growth_;
  std::vector<Piece> pieces_;
  std::vector<std::uint8_t> seen_;  ///< 1 for tiles that are taken, or of a piece that was refused
};

}  // namespace dominant_plane_detection
