#include "core/tile_seed.h"

#include "core/tile_neighbours.h"

namespace dominant_plane_detection {
namespace {

/// Three times three, less a third.
constexpr std::size_t kMinTiles = 6;

void add(const TileMoments& tiles, std::size_t tile, TileSeed& seed) {
  seed.tiles[seed.count++] = tile;
  seed.moments.add(static_cast<double>(tiles.count[tile]), tiles.centre(tile), tiles.scatter(tile));
}

bool fit(TileSeed& seed) {
  if (seed.count < kMinTiles) return false;
  const std::optional<PlaneFit> fit = seed.moments.fit();
  if (fit) seed.fit = *fit;
  return fit.has_value();
}

/// The tiles of `all` that lie on its plane.
TileSeed thoseOnPlane(TileJudge& judge, const TileSeed& all) {
  const TileMoments& tiles = judge.tiles();
  const int row = static_cast<int>(all.tiles[0]) / tiles.columns;
  judge.setPlane(all.fit.plane, tiles.centre(all.tiles[0]));
  judge.judgeRows(row - 1, row + 1);
  TileSeed kept;
  for (std::size_t i = 0; i < all.count; ++i) {
    if (judge.onPlane(all.tiles[i])) add(tiles, all.tiles[i], kept);
  }
  return kept;
}

}  // namespace

std::optional<TileSeed> fitSeed(TileJudge& judge, const std::vector<std::uint8_t>& taken,
                                std::size_t tile) {
  const TileMoments& tiles = judge.tiles();
  const TileLimits& limits = judge.limits();
  const auto usable = [&](std::size_t t) { return tiles.count[t] >= kMinReadings && !taken[t]; };
  if (!usable(tile)) return std::nullopt;
  TileSeed all;
  add(tiles, tile, all);
  forEachNeighbour(tile, tiles.columns, tiles.rows, [&](std::size_t neighbour) {
    if (usable(neighbour) && closerThanDelta(tiles, limits, neighbour, tile)) {
      add(tiles, neighbour, all);
    }
  });
  if (!fit(all)) return std::nullopt;
  TileSeed kept = thoseOnPlane(judge, all);
  if (kept.count == 0 || kept.tiles[0] != tile || !fit(kept)) return std::nullopt;
  double sum_epsilon2 = 0.0;
  for (std::size_t i = 0; i < kept.count; ++i) {
    const std::size_t t = kept.tiles[i];
    sum_epsilon2 += static_cast<double>(tiles.count[t]) * static_cast<double>(limits.epsilon2[t]);
  }
  const bool even = kept.fit.mean_square_error * kept.moments.count() < sum_epsilon2;
  return even ? std::optional<TileSeed>(kept) : std::nullopt;
}

}  // namespace dominant_plane_detection
