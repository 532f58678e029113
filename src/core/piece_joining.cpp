#include "core/piece_joining.h"

#include <algorithm>
#include <cmath>

#include "core/tile_neighbours.h"

namespace dominant_plane_detection {
namespace {

constexpr double kMaxAngle = 0.436;  // [rad] 25 degrees
/// Of the nine tiles about a seed, as many as a region starts from.
constexpr int kMinNeighbours = 5;

bool hasSeed(const TileMoments& tiles, const TileRegion& piece) {
  return std::any_of(piece.tiles.begin(), piece.tiles.end(), [&](std::size_t tile) {
    int neighbours = 0;
    forEachNeighbour(tile, tiles.columns, tiles.rows,
                     [&](std::size_t other) { neighbours += piece.member[other]; });
    return neighbours >= kMinNeighbours;
  });
}

bool hasSamePlane(const TileJudge& judge, const TileRegion& piece, const HessePlane& plane) {
  const TileMoments& tiles = judge.tiles();
  PlaneMoments moments;
  double sigma = 0.0;
  for (const std::size_t tile : piece.tiles) {
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

void PieceJoining::start(const TileMoments& tiles, double tile_angle) {
  growth_.start(tiles, tile_angle);
}

const std::vector<PieceJoining::Piece>& PieceJoining::join(TileJudge& judge,
                                                           const HessePlane& plane,
                                                           std::size_t min_points,
                                                           std::vector<std::uint8_t>& taken,
                                                           std::vector<std::size_t>& joined) {
  judge.judgeAll();
  seen_ = taken;
  pieces_.clear();
  const std::size_t size = judge.tiles().size();
  for (std::size_t tile = 0; tile < size; ++tile) {
    if (!judge.onPlane(tile) || seen_[tile]) continue;
    const TileRegion& piece = growth_.collect(judge, tile, seen_);
    for (const std::size_t t : piece.tiles) seen_[t] = 1;
    if (piece.points < min_points || !hasSeed(judge.tiles(), piece) ||
        !hasSamePlane(judge, piece, plane)) {
      continue;
    }
    for (const std::size_t t : piece.tiles) taken[t] = 1;
    const std::size_t begin = joined.size();
    joined.insert(joined.end(), piece.tiles.begin(), piece.tiles.end());
    pieces_.push_back({piece.points, begin, joined.size()});
  }
  return pieces_;
}

}  // namespace dominant_plane_detection
