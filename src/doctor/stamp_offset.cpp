#include "doctor/stamp_offset.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace dominant_plane_detection {
namespace {

/// @param others sorted, one at least.
double nearestOf(const std::vector<double>& others, double stamp) {
  auto nearest = std::lower_bound(others.begin(), others.end(), stamp);
  if (nearest == others.end()) return others.back() - stamp;
  if (nearest != others.begin() && stamp - *std::prev(nearest) < *nearest - stamp) --nearest;
  return *nearest - stamp;
}

}  // namespace

std::optional<double> stampOffset(const std::vector<double>& images, std::vector<double> others) {
  if (others.empty()) return std::nullopt;
  std::sort(others.begin(), others.end());
  std::optional<double> least;
  for (const double stamp : images) {
    const double offset = nearestOf(others, stamp);
    if (offset == 0.0) continue;
    if (!least || std::abs(offset) < std::abs(*least)) least = offset;
  }
  return least;
}

}  // namespace dominant_plane_detection
