#include "core/further_planes.h"

#include <algorithm>
#include <cmath>

#include "core/tile_seed.h"

namespace dominant_plane_detection {
namespace {

/// [#] tiles from seed to seed at most.
constexpr int kMostStep = 4;
/// [#] of all tiles: no further region is begun once so many joined, which bounds the work.
constexpr std::size_t kMostJoined = 8;
constexpr double kEpsilon = 1.5;  // [-] see the class

/// @return [#] tiles from seed to seed, half the side of the smallest plane.
int seedStep(std::size_t min_points) {
  const double tiles = static_cast<double>(min_points) / (kTileSize * kTileSize);
  return std::clamp(static_cast<int>(0.5 * std::sqrt(tiles)), 1, kMostStep);
}

}  // namespace

const std::vector<TilePlane>& FurtherPlanes::find(const TileMoments& tiles, double tile_angle,
                                                  const std::vector<std::uint8_t>& dominant,
                                                  const Limits& wanted) {
  GrowthThresholds thresholds = wanted.thresholds;
  thresholds.epsilon.offset *= kEpsilon;
  thresholds.epsilon.sigmas *= kEpsilon;
  limits_.set(tiles, thresholds);
  judge_.start(tiles, limits_);
  growth_.start(tiles, tile_angle);
  ground_tiles_.start(tiles, tile_angle);
  region_.tiles.clear();
  region_.member.assign(tiles.count.size(), 0);
  tried_ = taken_ = dominant;
  joined_ = 0;
  planes_.clear();
  const int step = seedStep(wanted.min_points);
  for (int row = step / 2; row < tiles.rows; row += step) {
    for (int column = step / 2; column < tiles.columns; column += step) {
      const auto tile = static_cast<std::size_t>(row * tiles.columns + column);
      const bool may_begin = !tried_[tile] && tiles.count[tile] >= kMinReadings;
      if (may_begin && joined_ <= kMostJoined * tiles.size()) tryRegion(tile, wanted);
    }
  }
  std::stable_sort(planes_.begin(), planes_.end(),
                   [](const TilePlane& a, const TilePlane& b) { return a.points > b.points; });
  return planes_;
}

void FurtherPlanes::tryRegion(std::size_t seed, const Limits& wanted) {
  const std::optional<TileSeed> start = fitSeed(judge_, taken_, seed);
  if (!start) return;
  const TileRegion& grown = growth_.grow(judge_, *start, taken_);
  joined_ += grown.tiles.size();
  for (const std::size_t tile : grown.tiles) tried_[tile] = 1;
  if (grown.points < wanted.min_points) return;
  const std::optional<SurfacePlane> surface = findSurface(judge_, grown);
  if (!surface || !ground_tiles_.collectSurface(judge_, *surface, grown.tiles, wanted.pieces,
                                                taken_, region_)) {
    return;
  }
  for (const std::size_t tile : ground_tiles_.pieces()) region_.add(tile, judge_.tiles());
  const std::optional<SurfacePlane> fit = fitPlane(judge_, region_, surface->plane, surface->level);
  if (!fit || region_.points < wanted.min_points) return;
  region_.plane = fit->plane;
  if (!SurfaceCheck::isFlat(judge_, region_)) return;
  planes_.push_back({region_.plane, region_.points, ground_tiles_.ground()});
  for (const std::size_t tile : region_.tiles) tried_[tile] = taken_[tile] = 1;
}

}  // namespace dominant_plane_detection
