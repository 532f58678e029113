#include "core/tile_growth.h"

#include <algorithm>
#include <cmath>

#include "core/tile_neighbours.h"

namespace dominant_plane_detection {
namespace {

/// The plane is fitted again whenever the region has grown by this factor.
constexpr double kRefitGrowth = 1.5;

}  // namespace

void TileGrowth::start(const TileMoments& tiles, double tile_angle) {
  columns_ = tiles.columns;
  rows_ = tiles.rows;
  tile_angle_ = static_cast<float>(tile_angle);
  region_.tiles.clear();
  region_.member.assign(tiles.count.size(), 0);
}

void TileGrowth::clear() {
  for (const std::size_t tile : region_.tiles) region_.member[tile] = 0;
  region_.tiles.clear();
  region_.points = 0;
  box_ = {columns_, rows_, -1, -1};
  reach_ = 0;
  moments_ = PlaneMoments();
  sum_epsilon2_ = sum_square_ = fitted_count_ = 0.0;
  fits_ = tests_ = 0;
}

void TileGrowth::join(const TileJudge& judge, std::size_t tile, Mode mode) {
  const TileMoments& tiles = judge.tiles();
  const double count = static_cast<double>(tiles.count[tile]);
  region_.member[tile] = 1;
  region_.tiles.push_back(tile);
  region_.points += static_cast<std::size_t>(count);
  sum_epsilon2_ += count * static_cast<double>(judge.limits().epsilon2[tile]);
  const int column = static_cast<int>(tile) % columns_, row = static_cast<int>(tile) / columns_;
  box_ = {std::min(box_.left, column), std::min(box_.top, row), std::max(box_.right, column),
          std::max(box_.bottom, row)};
  reach_ = std::max(reach_, reach(judge, tile));
  if (mode == Mode::kGrow) moments_.add(count, tiles.centre(tile), tiles.scatter(tile));
}

bool TileGrowth::mayJoin(const TileJudge& judge, std::size_t tile, Mode mode,
                         const std::vector<std::uint8_t>& taken) const {
  const TileVerdict least = mode == Mode::kSurround ? TileVerdict::kTouches : TileVerdict::kOnPlane;
  return judge.verdict(tile) >= least && !region_.member[tile] && !taken[tile];
}

void TileGrowth::tryToJoin(const TileJudge& judge, std::size_t tile, std::size_t from, Mode mode,
                           const std::vector<std::uint8_t>& taken) {
  if (!mayJoin(judge, tile, mode, taken)) return;
  ++tests_;
  const TileMoments& tiles = judge.tiles();
  if (!closerThanDelta(tiles, judge.limits(), tile, from)) return;
  const double count = static_cast<double>(tiles.count[tile]);
  const double sum_square = sum_square_ + count * static_cast<double>(judge.meanSquare(tile));
  const double sum_epsilon2 =
      sum_epsilon2_ + count * static_cast<double>(judge.limits().epsilon2[tile]);
  if (mode != Mode::kSurround && sum_square >= sum_epsilon2) return;
  sum_square_ = sum_square;
  join(judge, tile, mode);
}

const TileRegion& TileGrowth::grow(TileJudge& judge, const TileSeed& seed,
                                   const std::vector<std::uint8_t>& taken) {
  clear();
  for (std::size_t i = 0; i < seed.count; ++i) join(judge, seed.tiles[i], Mode::kGrow);
  refit(judge);
  spread(judge, Mode::kGrow, taken);
  refit(judge);
  return region_;
}

const TileRegion& TileGrowth::collect(TileJudge& judge, std::size_t first,
                                      const std::vector<std::uint8_t>& taken) {
  clear();
  join(judge, first, Mode::kCollect);
  sum_square_ = static_cast<double>(judge.tiles().count[first]) *
                static_cast<double>(judge.meanSquare(first));
  spread(judge, Mode::kCollect, taken);
  return region_;
}

const TileRegion& TileGrowth::surround(TileJudge& judge, const std::vector<std::size_t>& tiles,
                                       const std::vector<std::uint8_t>& taken) {
  clear();
  for (const std::size_t tile : tiles) join(judge, tile, Mode::kSurround);
  spread(judge, Mode::kSurround, taken);
  return region_;
}

/// First come, first served: rings about the seed, as good as "nearest first" on a grid.
void TileGrowth::spread(TileJudge& judge, Mode mode, const std::vector<std::uint8_t>& taken) {
  std::size_t next = 0;
  do {
    for (; next < region_.tiles.size(); ++next) {
      const std::size_t from = region_.tiles[next];
      const int row = static_cast<int>(from) / columns_;
      judge.judgeRows(row - 1, row + 1);
      forEachNeighbour(from, columns_, rows_,
                       [&](std::size_t tile) { tryToJoin(judge, tile, from, mode, taken); });
      if (mode == Mode::kGrow && moments_.count() > kRefitGrowth * fitted_count_) refit(judge);
    }
  } while (bridgeGaps(judge, mode, taken));
}

/// @return [tile] how far away in the image a tile within delta can be.
int TileGrowth::reach(const TileJudge& judge, std::size_t tile) const {
  const TileLimits& limits = judge.limits();
  const float side = judge.tiles().z[tile] * tile_angle_;
  const float tiles = (limits.delta[tile] + 2.0F * limits.radius[tile]) / side;
  return 1 + static_cast<int>(std::min(tiles, static_cast<float>(std::max(columns_, rows_))));
}

/// @return a tile of the region within delta of a tile, or `tile` itself if there is none.
std::size_t TileGrowth::closeMember(const TileJudge& judge, std::size_t tile) const {
  const int column = static_cast<int>(tile) % columns_, row = static_cast<int>(tile) / columns_;
  const int radius = reach(judge, tile);
  const int right = std::min(column + radius, box_.right);
  const int bottom = std::min(row + radius, box_.bottom);
  for (int r = std::max(row - radius, box_.top); r <= bottom; ++r) {
    for (int c = std::max(column - radius, box_.left); c <= right; ++c) {
      const auto other = static_cast<std::size_t>(r * columns_ + c);
      if (region_.member[other] && closerThanDelta(judge.tiles(), judge.limits(), tile, other)) {
        return other;
      }
    }
  }
  return tile;
}

/// Joins tiles that have no neighbour in the region, but come closer to it than delta: across what
/// has no reading, or stands before the plane. Only the rims of what is left need to be looked at.
/// @return whether there were any.
bool TileGrowth::bridgeGaps(TileJudge& judge, Mode mode, const std::vector<std::uint8_t>& taken) {
  const std::size_t before = region_.tiles.size();
  const auto left = [&](std::size_t tile) { return mayJoin(judge, tile, mode, taken); };
  const Box around{std::max(box_.left - reach_, 0), std::max(box_.top - reach_, 0),
                   std::min(box_.right + reach_, columns_ - 1),
                   std::min(box_.bottom + reach_, rows_ - 1)};
  judge.judgeRows(around.top - 1, around.bottom + 1);
  for (int row = around.top; row <= around.bottom; ++row) {
    for (int column = around.left; column <= around.right; ++column) {
      const auto tile = static_cast<std::size_t>(row * columns_ + column);
      if (!left(tile)) continue;
      int neighbours = 0;
      forEachNeighbour(tile, columns_, rows_,
                       [&](std::size_t other) { neighbours += left(other); });
      if (neighbours == 8) continue;
      const std::size_t from = closeMember(judge, tile);
      if (from != tile) tryToJoin(judge, tile, from, mode, taken);
    }
  }
  return region_.tiles.size() > before;
}

void TileGrowth::refit(TileJudge& judge) {
  const std::optional<PlaneFit> fit = moments_.fit();
  ++fits_;
  if (!fit) return;
  region_.plane = fit->plane;
  fitted_count_ = moments_.count();
  sum_square_ = fit->mean_square_error * fitted_count_;
  judge.setPlane(region_.plane, judge.tiles().centre(region_.tiles.front()));
}

}  // namespace dominant_plane_detection
