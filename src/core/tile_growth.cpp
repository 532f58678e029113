#include "core/tile_growth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace dominant_plane_detection {
namespace {

/// The plane is fitted again whenever the region has grown by this factor.
constexpr double kRefitGrowth = 1.5;

/// @return from a place of a row-major grid to its eight neighbours, row by row; numbers wrap
/// round.
std::array<std::size_t, 8> stepsToNeighbours(std::size_t columns) {
  return {0 - columns - 1, 0 - columns, 0 - columns + 1, std::size_t{0} - 1, 1,
          columns - 1,     columns,     columns + 1};
}

}  // namespace

void TileGrowth::start(const TileMoments& tiles, double tile_angle) {
  columns_ = tiles.columns;
  rows_ = tiles.rows;
  tile_angle_ = static_cast<float>(tile_angle);
  region_.tiles.clear();
  region_.member.assign(tiles.count.size(), 0);
  // Eight more, to be read eight at a time.
  open_.assign(static_cast<std::size_t>(columns_ + 2) * static_cast<std::size_t>(rows_ + 2) + 8, 0);
  looked_.resize(static_cast<std::size_t>(rows_));
}

void TileGrowth::clear() {
  region_.clear();
  places_.clear();
  std::fill(looked_.begin(), looked_.end(), std::uint8_t{0});
  moments_ = PlaneMoments();
  sum_epsilon2_ = sum_square_ = fitted_count_ = 0.0;
  fits_ = tests_ = 0;
}

TileGrowth::Place TileGrowth::placeOf(std::size_t tile) const {
  const auto columns = static_cast<std::size_t>(columns_);
  return {tile, tile + 2 * (tile / columns) + columns + 3};
}

/// Finds out which tiles of the rows [first, last], as far as the image has them, may join.
void TileGrowth::look(const Call& call, int first_row, int last_row) {
  const TileVerdict least =
      call.mode == Mode::kSurround ? TileVerdict::kTouches : TileVerdict::kOnPlane;
  const int last = std::min(last_row, rows_ - 1);
  for (int row = std::max(first_row, 0); row <= last; ++row) {
    if (looked_[static_cast<std::size_t>(row)]) continue;
    looked_[static_cast<std::size_t>(row)] = 1;
    call.judge.judgeRows(row, row);
    const auto columns = static_cast<std::size_t>(columns_);
    const std::size_t first = static_cast<std::size_t>(row) * columns;
    // The compiler is told that these do not overlap, as bytes might: it then takes many at once.
    const TileVerdict* __restrict verdict = call.judge.verdicts() + first;
    const std::uint8_t* __restrict taken = call.taken.data() + first;
    const std::uint8_t* __restrict member = region_.member.data() + first;
    std::uint8_t* __restrict open = &open_[placeOf(first).open];
    for (std::size_t i = 0; i < columns; ++i) {
      open[i] =
          static_cast<std::uint8_t>((verdict[i] >= least) & (taken[i] == 0) & (member[i] == 0));
    }
  }
}

void TileGrowth::join(const Call& call, const Place& place) {
  const TileMoments& tiles = call.judge.tiles();
  const std::size_t tile = place.tile;
  const double count = static_cast<double>(tiles.count[tile]);
  region_.add(tile, tiles);
  places_.push_back(place.open);
  open_[place.open] = 0;
  sum_epsilon2_ += count * static_cast<double>(call.judge.limits().epsilon2[tile]);
  if (call.mode == Mode::kGrow) moments_.add(count, tiles.centre(tile), tiles.scatter(tile));
}

void TileGrowth::tryToJoin(const Call& call, const Place& place, std::size_t from) {
  ++tests_;
  const TileMoments& tiles = call.judge.tiles();
  const TileLimits& limits = call.judge.limits();
  if (!closerThanDelta(tiles, limits, place.tile, from)) return;
  const double count = static_cast<double>(tiles.count[place.tile]);
  const double sum_square =
      sum_square_ + count * static_cast<double>(call.judge.meanSquare(place.tile));
  const double sum_epsilon2 =
      sum_epsilon2_ + count * static_cast<double>(limits.epsilon2[place.tile]);
  if (call.mode != Mode::kSurround && sum_square >= sum_epsilon2) return;
  sum_square_ = sum_square;
  join(call, place);
}

const TileRegion& TileGrowth::grow(TileJudge& judge, const TileSeed& seed,
                                   const std::vector<std::uint8_t>& taken) {
  const Call call{judge, taken, Mode::kGrow};
  clear();
  for (std::size_t i = 0; i < seed.count; ++i) join(call, placeOf(seed.tiles[i]));
  refit(judge);
  spread(call);
  refit(judge);
  return region_;
}

const TileRegion& TileGrowth::surround(TileJudge& judge, const std::vector<std::size_t>& tiles,
                                       const std::vector<std::uint8_t>& taken) {
  const Call call{judge, taken, Mode::kSurround};
  clear();
  for (const std::size_t tile : tiles) join(call, placeOf(tile));
  spread(call);
  return region_;
}

/// First come, first served: rings about the seed, as good as "nearest first" on a grid.
void TileGrowth::spread(const Call& call) {
  const auto columns = static_cast<std::size_t>(columns_);
  const std::array<std::size_t, 8> tile_steps = stepsToNeighbours(columns);
  const std::array<std::size_t, 8> open_steps = stepsToNeighbours(columns + 2);
  std::size_t next = 0;
  do {
    for (; next < region_.tiles.size(); ++next) {
      const std::size_t from = region_.tiles[next], open = places_[next];
      const int row = static_cast<int>(open / (columns + 2)) - 1;
      look(call, row - 1, row + 1);
      for (std::size_t k = 0; k < tile_steps.size(); ++k) {
        const Place place{from + tile_steps[k], open + open_steps[k]};
        if (open_[place.open]) tryToJoin(call, place, from);
      }
      if (call.mode == Mode::kGrow && moments_.count() > kRefitGrowth * fitted_count_) {
        refit(call.judge);
      }
    }
  } while (bridgeGaps(call));
}

/// @return [tile] how far away in the image a tile within delta can be.
int TileGrowth::reach(const TileJudge& judge, std::size_t tile) const {
  const TileLimits& limits = judge.limits();
  const float side = judge.tiles().z[tile] * tile_angle_;
  const float tiles = (limits.delta[tile] + 2.0F * limits.radius[tile]) / side;
  return 1 + static_cast<int>(std::min(tiles, static_cast<float>(std::max(columns_, rows_))));
}

/// @return a tile of the region within delta of a tile, or that tile itself if there is none.
std::size_t TileGrowth::closeMember(const TileJudge& judge, int column, int row) const {
  const auto tile = static_cast<std::size_t>(row * columns_ + column);
  const int radius = reach(judge, tile);
  const int right = std::min(column + radius, columns_ - 1);
  const int bottom = std::min(row + radius, rows_ - 1);
  for (int r = std::max(row - radius, 0); r <= bottom; ++r) {
    for (int c = std::max(column - radius, 0); c <= right; ++c) {
      const auto other = static_cast<std::size_t>(r * columns_ + c);
      if (region_.member[other] && closerThanDelta(judge.tiles(), judge.limits(), tile, other)) {
        return other;
      }
    }
  }
  return tile;
}

/// @return [tile] how far away in the image from any of its tiles a tile within delta can be.
int TileGrowth::reachOfRegion(const TileJudge& judge) const {
  // A large region is seldom far from any row: what it would save is not worth the look.
  constexpr std::size_t kLarge = 200;
  if (region_.tiles.size() > kLarge) return rows_;
  int most = 0;
  for (const std::size_t tile : region_.tiles) most = std::max(most, reach(judge, tile));
  return most;
}

/// Joins tiles that have no neighbour in the region, but come closer to it than delta: across what
/// has no reading, or stands before the plane. Only the rims of what is left need to be looked at.
/// @return whether there were any.
bool TileGrowth::bridgeGaps(const Call& call) {
  if (places_.empty()) return false;
  const auto columns = static_cast<std::size_t>(columns_);
  const auto rowOf = [&](std::size_t open) { return static_cast<int>(open / (columns + 2)) - 1; };
  const auto [top, bottom] = std::minmax_element(places_.begin(), places_.end());
  const int margin = reachOfRegion(call.judge);
  const int first = std::max(rowOf(*top) - margin, 0);
  const int last = std::min(rowOf(*bottom) + margin, rows_ - 1);
  look(call, first - 1, last + 1);
  const std::size_t before = region_.tiles.size();
  const auto steps = stepsToNeighbours(columns + 2);
  const auto end = static_cast<std::size_t>(last + 2) * (columns + 2);
  for (auto open = static_cast<std::size_t>(first + 1) * (columns + 2); open < end; ++open) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, &open_[open], sizeof(eight));
    if (eight == 0) {  // most of them
      open += sizeof(eight) - 1;
      continue;
    }
    if (!open_[open]) continue;
    const bool inside = std::all_of(steps.begin(), steps.end(),
                                    [&](std::size_t step) { return open_[open + step] != 0; });
    if (inside) continue;
    const int row = rowOf(open);
    const int column =
        static_cast<int>(open - static_cast<std::size_t>(row + 1) * (columns + 2)) - 1;
    const Place place{static_cast<std::size_t>(row * columns_ + column), open};
    const std::size_t from = closeMember(call.judge, column, row);
    if (from != place.tile) tryToJoin(call, place, from);
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
  std::fill(looked_.begin(), looked_.end(), std::uint8_t{0});
}

}  // namespace dominant_plane_detection
