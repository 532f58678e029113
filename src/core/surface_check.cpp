#include "core/surface_check.h"

#include <algorithm>
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

}  // namespace

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

bool SurfaceCheck::isSurface(TileJudge& judge, const TileRegion& region) {
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
