#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/plane_moments.h"
#include "core/tile_judge.h"
#include "core/tile_seed.h"

namespace dominant_plane_detection {

/// Tiles that hang together and lie on one plane.
struct TileRegion {
  HessePlane plane;
  std::size_t points = 0;            ///< [px]
  std::vector<std::size_t> tiles;    ///< in the order they joined
  std::vector<std::uint8_t> member;  ///< 1 for these, padded like the moments

  void clear() {
    for (const std::size_t tile : tiles) member[tile] = 0;
    tiles.clear();
    points = 0;
  }
  /// Becomes the tiles that are 1.
  /// @param chosen padded like the moments.
  void fill(const std::vector<std::uint8_t>& chosen, const TileMoments& moments) {
    clear();
    member.resize(moments.count.size());
    for (std::size_t tile = 0; tile < moments.size(); ++tile) {
      if (chosen[tile]) add(tile, moments);
    }
  }
  /// @pre the tile is no member.
  void add(std::size_t tile, const TileMoments& moments) {
    member[tile] = 1;
    tiles.push_back(tile);
    points += static_cast<std::size_t>(moments.count[tile]);
  }
};

/// The region growing of section III.B over image tiles: what joins the region is a tile of points
/// at a time, whose moments merge as in Eq. 10.
///
/// The three thresholds keep their meaning. delta: a tile's points come closer than this to the
/// region's; neighbours in the image come first, then tiles beyond a gap in the image that is
/// narrower than this in space. epsilon: the mean square error of region and tile together stays
/// below the mean of epsilon(z)^2 over their points. gamma: the tile's points are closer than this
/// to the plane (see `PlaneTest`).
class TileGrowth {
 public:
  /// @param tile_angle [rad] that a tile's side subtends in the middle of the image.
  void start(const TileMoments& tiles, double tile_angle);

  /// Grows a region whose plane is fitted again whenever it has grown by half: fewer points hardly
  /// turn it, and any plane's error bounds that of the best one, lambda_min(A) <= m^T A m.
  /// @param judge is left with the region's plane.
  /// @param taken 1 for tiles of other regions, which do not join.
  const TileRegion& grow(TileJudge& judge, const TileSeed& seed,
                         const std::vector<std::uint8_t>& taken);

  /// Collects all that hangs together with some tiles and touches the judge's plane, or lies on it,
  /// by delta alone.
  const TileRegion& surround(TileJudge& judge, const std::vector<std::size_t>& tiles,
                             const std::vector<std::uint8_t>& taken);

  /// @return [#] of plane fits that the last `grow` made.
  std::size_t fits() const { return fits_; }
  /// @return [#] of tiles on the plane that were held against delta and epsilon since it began.
  std::size_t tests() const { return tests_; }

 private:
  /// What joins, and what becomes of the plane.
  enum class Mode {
    kGrow,      ///< tiles on the plane, within epsilon; the plane is fitted again
    kSurround,  ///< tiles that touch the plane, which stays
  };

  /// What the present call looks at.
  struct Call {
    TileJudge& judge;
    const std::vector<std::uint8_t>& taken;
    Mode mode;
  };
  /// A tile and its place in `open_`.
  struct Place {
    std::size_t tile;
    std::size_t open;
  };

  void clear();
  Place placeOf(std::size_t tile) const;
  void look(const Call& call, int first_row, int last_row);
  void join(const Call& call, const Place& place);
  void tryToJoin(const Call& call, const Place& place, std::size_t from);
  void spread(const Call& call);
  bool bridgeGaps(const Call& call);
  std::size_t closeMember(const TileJudge& judge, int column, int row) const;
  int reach(const TileJudge& judge, std::size_t tile) const;
  int reachOfRegion(const TileJudge& judge) const;
  void refit(TileJudge& judge);

  int columns_ = 0;
  int rows_ = 0;
  float tile_angle_ = 0.0F;
  TileRegion region_;
  std::vector<std::size_t> places_;  ///< of the region's tiles in `open_`
  /// 1 for tiles that may join; with a margin of one tile on each side of the image, so that a
  /// neighbour needs no look at where the image ends.
  std::vector<std::uint8_t> open_;
  std::vector<std::uint8_t> looked_;  ///< 1 for each row of tiles that `open_` is right about
  PlaneMoments moments_;
  double fitted_count_ = 0.0;  ///< [px] in the region at the last fit
  double sum_epsilon2_ = 0.0;  ///< [m^2] over the region's points
  double sum_square_ = 0.0;    ///< [m^2] of their heights over the planes they were judged by
  std::size_t fits_ = 0;
  std::size_t tests_ = 0;
};

}  // namespace dominant_plane_detection
