#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/growth_thresholds.h"
#include "core/plane_moments.h"
#include "core/tile_moments.h"

namespace dominant_plane_detection {

/// The region growing of section III.B over image tiles: what joins the region is a tile of points
/// at a time, whose moments merge as in Eq. 10, and its neighbours are those in the image.
///
/// The three thresholds keep their meaning. delta: a tile's points come closer than this to the
/// region's. epsilon: the mean square error of region and tile together stays below the mean of
/// epsilon(z)^2 over their points. gamma: the tile's points, its mean and two standard deviations
/// to either side, are closer than this to the plane.
class GridRegionGrowing {
 public:
  struct Region {
    HessePlane plane;
    std::size_t points = 0;  ///< [px]
  };

  /// Forgets all regions.
  /// @param tiles of the image; has to outlive the calls below.
  void start(const TileMoments& tiles, const GrowthThresholds& thresholds);

  /// @return whether the tile holds enough points to join, and belongs to no region yet.
  bool available(std::size_t tile) const { return usable(tile) && !claimed_[tile]; }

  /// @return [px] points in the tiles that are available.
  std::size_t availablePoints() const { return available_points_; }

  /// Starts a region from a tile and those about it, and claims the tile.
  /// @return the region's first plane; nothing where these tiles are no plane.
  std::optional<HessePlane> startRegion(std::size_t seed);

  /// Claims the tiles that the last region was started from.
  void claimStart();

  /// Grows the region that was started until there is nothing left to join, or until its plane has
  /// settled: what more would join then is what `refine` takes. Grows over tiles of earlier regions
  /// as well, and claims its own.
  /// @pre the last `startRegion` gave a plane.
  Region grow();

  /// Refits a plane to all tiles on it, wherever they are in the image, and claims them: the pieces
  /// that obstacles cut off join, and what the growing picked up while its plane was poor leaves.
  /// Weighted by 1 / sigma(z)^2, so that far, noisy points do not lever the plane.
  /// @param worthwhile [px] a plane with fewer points is not refined to the end.
  /// @return the region of the refitted plane; nothing if too few tiles lie on it.
  std::optional<Region> refine(const HessePlane& plane, std::size_t worthwhile = 0);

 private:
  /// Mean and variance of the heights of a tile's points over a plane.
  struct Height {
    double mean;      ///< [m]
    double variance;  ///< [m^2]
  };

  bool usable(std::size_t tile) const { return tiles_->count[tile] >= min_count_; }
  Height height(std::size_t tile, const HessePlane& plane) const;
  bool within(const Height& height, double limit) const;
  bool close(std::size_t tile, std::size_t neighbour) const;
  void claim(std::size_t tile);
  void claimTilesOnPlane();
  bool fitSeed(std::size_t seed);
  bool tryToJoin(std::size_t tile);
  void join(std::size_t tile);
  bool refit();
  bool settled(const HessePlane& before) const;

  const TileMoments* tiles_ = nullptr;
  float min_count_ = 0.0F;
  NoiseModel noise_;
  std::vector<float> delta_;     ///< [m] of each tile
  std::vector<float> epsilon2_;  ///< [m^2]
  std::vector<float> gamma_;     ///< [m]
  std::vector<float> radius_;    ///< [m] half the extent of the tile's points
  std::vector<float> weight_;    ///< [1/m^2] 1 / sigma^2
  DepthThreshold gamma_of_z_;
  double nearest_ = 0.0;   ///< [m] depth of the usable tiles
  double farthest_ = 0.0;  ///< [m]
  std::vector<std::uint8_t> on_plane_;
  std::vector<std::uint8_t> claimed_;
  std::size_t available_points_ = 0;

  std::vector<std::uint32_t> joined_;  ///< number of the last growth that a tile joined
  std::uint32_t growth_ = 0;
  std::vector<std::size_t> region_;  ///< tiles in the order they joined
  PlaneMoments moments_;
  PlaneFit fit_;
  double sum_epsilon2_ = 0.0;  ///< [m^2] over the region's points
  double fitted_count_ = 0.0;  ///< points at the last fit
};

}  // namespace dominant_plane_detection
