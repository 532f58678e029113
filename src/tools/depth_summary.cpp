#include "depth_summary.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace dominant_plane_detection {

std::string describeDepths(const DepthView& depth) {
  std::vector<float> readings;
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      const float z = metresAt(depth, u, v);
      if (std::isfinite(z) && z > 0.0F) readings.push_back(z);
    }
  }
  if (readings.empty()) return "There are no readings at all.";
  const auto percentile = [&](std::size_t percent) {
    const auto at =
        readings.begin() + static_cast<std::ptrdiff_t>((readings.size() - 1) * percent / 100);
    std::nth_element(readings.begin(), at, readings.end());
    return static_cast<double>(*at);
  };
  const double near = percentile(5), far = percentile(95);
  char text[160];
  std::snprintf(
      text, sizeof(text),
      "Nine of ten readings are from %.4g to %.4g m: is --depth-scale right, and --range?", near,
      far);
  return text;
}

}  // namespace dominant_plane_detection
