#include "core/surface_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dominant_plane_detection {
namespace {

constexpr double kOutside = -std::numeric_limits<double>::infinity();

/// Raises values to the smallest concave function above them, between the first and the last that
/// is not kOutside: one side of a convex hull (Andrew's monotone chain).
/// @param corners is overwritten.
void raiseToConcave(std::vector<double>& values, std::vector<std::size_t>& corners) {
  const auto slope = [&](std::size_t from, std::size_t to) {
    return (values[to] - values[from]) / static_cast<double>(to - from);
  };
  corners.clear();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == kOutside) continue;
    while (corners.size() >= 2 &&
           slope(corners[corners.size() - 2], corners.back()) <= slope(corners.back(), i)) {
      corners.pop_back();
    }
    corners.push_back(i);
  }
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const std::size_t from = corners[k - 1];
    const double rise = slope(from, corners[k]);
    for (std::size_t i = from + 1; i < corners[k]; ++i) {
      values[i] = values[from] + rise * static_cast<double>(i - from);
    }
  }
}

constexpr double kMaxBend = 0.035;  // [rad] 2 degrees
/// Tiles that the halves' planes are fitted to.
constexpr std::size_t kSample = 256;

/// One half of a region.
struct Half {
  PlaneMoments moments;
  double sigma = 0.0;  ///< [m] summed over the points

  void add(const TileJudge& judge, std::size_t tile) {
    const TileMoments& tiles = judge.tiles();
    const double count = static_cast<double>(tiles.count[tile]);
    moments.add(count, tiles.centre(tile), tiles.scatter(tile));
    sigma += count / static_cast<double>(judge.limits().inverse_sigma[tile]);
  }
  /// @return [rad] by which a step of sigma(z) over its width turns a plane through it.
  double tolerance(const PlaneFit& fit) const {
    return std::atan(sigma / moments.count() / std::sqrt(fit.eigenvalues[1] / moments.count()));
  }
};

/// @return whether the planes of two halves are the same; where one has none they are.
bool haveSamePlane(const Half& a, const Half& b) {
  const std::optional<PlaneFit> fit_a = a.moments.fit(), fit_b = b.moments.fit();
  if (!fit_a || !fit_b) return true;
  const double cosine = std::abs(fit_a->plane.normal.dot(fit_b->plane.normal));
  const double noise = 0.5 * std::hypot(a.tolerance(*fit_a), b.tolerance(*fit_b));
  return std::acos(std::min(cosine, 1.0)) < kMaxBend + noise;
}

}  // namespace

bool SurfaceCheck::isFlat(const TileJudge& judge, const TileRegion& region) {
  const auto columns = static_cast<std::size_t>(judge.tiles().columns);
  const std::size_t size = std::min(region.tiles.size(), kSample);
  const auto forEach = [&](auto function) {
    for (std::size_t i = 0; i < size; ++i) function(region.tiles[i * region.tiles.size() / size]);
  };
  std::size_t sum_columns = 0, sum_rows = 0;
  forEach([&](std::size_t tile) {
    sum_columns += tile % columns;
    sum_rows += tile / columns;
  });
  std::array<Half, 2> sides, levels;
  forEach([&](std::size_t tile) {
    sides[tile % columns * size < sum_columns].add(judge, tile);
    levels[tile / columns * size < sum_rows].add(judge, tile);
  });
  return haveSamePlane(sides[0], sides[1]) && haveSamePlane(levels[0], levels[1]);
}

void SurfaceCheck::findHull(const TileMoments& tiles, const TileRegion& region) {
  left_.assign(static_cast<std::size_t>(tiles.rows), kOutside);
  right_.assign(static_cast<std::size_t>(tiles.rows), kOutside);
  const auto columns = static_cast<std::size_t>(tiles.columns);
  for (const std::size_t tile : region.tiles) {
    const std::size_t row = tile / columns;
    const auto column = static_cast<double>(tile % columns);
    left_[row] = std::max(left_[row], -column);
    right_[row] = std::max(right_[row], column);
  }
  raiseToConcave(left_, corners_);
  raiseToConcave(right_, corners_);
}

bool SurfaceCheck::isFilled(TileJudge& judge, const TileRegion& region) {
  judge.judgeAll();
  const TileMoments& tiles = judge.tiles();
  findHull(tiles, region);
  const auto columns = static_cast<std::size_t>(tiles.columns);
  std::size_t on = 0, farther = 0;
  for (std::size_t row = 0; row < right_.size(); ++row) {
    if (right_[row] == kOutside) continue;
    const auto first = row * columns + static_cast<std::size_t>(std::ceil(-left_[row]));
    const auto last = row * columns + static_cast<std::size_t>(std::floor(right_[row]));
    for (std::size_t tile = first; tile <= last; ++tile) {
      if (tiles.count[tile] < kMinReadings) continue;
      const bool nearer = judge.height(tile) < -judge.limits().gamma[tile];
      on += judge.onPlane(tile);
      farther += !judge.onPlane(tile) && !nearer;
    }
  }
  return on >= farther;
}

}  // namespace dominant_plane_detection
