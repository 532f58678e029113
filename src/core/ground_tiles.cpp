#include "core/ground_tiles.h"

#include <algorithm>
#include <cmath>

#include "core/tile_neighbours.h"

namespace dominant_plane_detection {
namespace {

constexpr double kMaxAngle = 0.436;  // [rad] 25 degrees
/// Of the eight tiles about a seed, as many as a region starts from.
constexpr int kMinNeighbours = 5;

bool hasSeed(const TileJudge& judge, const TileRegion& piece) {
  const TileMoments& tiles = judge.tiles();
  return std::any_of(piece.tiles.begin(), piece.tiles.end(), [&](std::size_t tile) {
    if (!judge.onPlane(tile)) return false;
    int neighbours = 0;
    forEachNeighbour(tile, tiles.columns, tiles.rows,
                     [&](std::size_t other) { neighbours += judge.onPlane(other); });
    return neighbours >= kMinNeighbours;
  });
}

bool hasSamePlane(const TileJudge& judge, const TileRegion& piece, const HessePlane& plane) {
  const TileMoments& tiles = judge.tiles();
  PlaneMoments moments;
  double sigma = 0.0;
  for (const std::size_t tile : piece.tiles) {
    if (!judge.onPlane(tile)) continue;
    const double count = static_cast<double>(tiles.count[tile]);
    moments.add(count, tiles.centre(tile), tiles.scatter(tile));
    sigma += count / static_cast<double>(judge.limits().inverse_sigma[tile]);
  }
  const std::optional<PlaneFit> fit = moments.fit();
  if (!fit) return false;
  const double width = std::sqrt(fit->eigenvalues[1] / moments.count());
  const double angle = std::acos(std::min(std::abs(fit->plane.normal.dot(plane.normal)), 1.0));
  return angle < kMaxAngle + std::atan(sigma / moments.count() / width);
}

}  // namespace

void GroundTiles::collect(TileJudge& judge, TileRegion& region, const Limits& limits,
                          const std::vector<std::uint8_t>& other) {
  judge.judgeAll();
  const std::size_t size = judge.tiles().size();
  ground_.assign(judge.tiles().count.size(), 0);
  pieces_.clear();
  seen_ = other;
  for (const std::size_t tile : growth_.surround(judge, region.tiles, seen_).tiles) {
    ground_[tile] = seen_[tile] = 1;
    if (judge.onPlane(tile) && !region.member[tile]) region.add(tile, judge.tiles());
  }
  if (!limits.join_pieces) return;
  for (std::size_t tile = 0; tile < size; ++tile) {
    if (judge.verdict(tile) == TileVerdict::kOff || seen_[tile]) continue;
    beginning_.assign(1, tile);
    const TileRegion& piece = growth_.surround(judge, beginning_, seen_);
    for (const std::size_t t : piece.tiles) seen_[t] = 1;
    if (piece.points < limits.min_piece || !hasSeed(judge, piece) ||
        !hasSamePlane(judge, piece, region.plane)) {
      continue;
    }
    for (const std::size_t t : piece.tiles) {
      ground_[t] = 1;
      if (judge.onPlane(t)) pieces_.push_back(t);
    }
  }
}

bool GroundTiles::collectSurface(TileJudge& judge, const SurfacePlane& surface,
                                 const std::vector<std::size_t>& tiles, const Limits& limits,
                                 const std::vector<std::uint8_t>& other, TileRegion& region) {
  region.clear();
  region.plane = surface.plane;
  judge.setPlane(surface.plane, surface.plane.distance * surface.plane.normal, surface.level);
  judge.judgeAll();
  for (const std::size_t tile : tiles) {
    if (judge.onPlane(tile)) region.add(tile, judge.tiles());
  }
  if (region.tiles.empty()) return false;
  collect(judge, region, limits, other);
  return true;
}

}  // namespace dominant_plane_detection
