#include "doctor/depth_spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dominant_plane_detection {
namespace {

/// What cameras of the kind see: a Kinect v1 0.5 to 8 m (10 m at the most), a RealSense D4xx 0.2 or
/// 0.3 m to 10 m, and noise beyond.
constexpr double kNearest = 0.2;      // [m] nothing is nearer
constexpr double kNearestMost = 0.3;  // [m] nor is half of an image
constexpr double kFarthest = 10.0;    // [m]
/// [m] Some of the readings may be noise from farther, but then the near ones are not far, too: who
/// sees the ground within the trusted 4 m has a tenth of the image nearer than this.
constexpr double kNothingNear = 2.0;
constexpr int kStep = 4;              // [px]
constexpr std::size_t kFewest = 500;  // [#] readings

double quantile(std::vector<float>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

bool isMultipleOf5(const DepthView& depth, int u, int v) {
  return depth.type == DepthView::Type::kUint16 && depth.row<std::uint16_t>(v)[u] % 5 == 0;
}

}  // namespace

DepthSpread DepthSpread::scaled(double factor) const {
  return {factor * near, factor * median, factor * far, false, known};
}

DepthSpread spreadOf(const DepthView& depth) {
  std::vector<float> values;
  std::size_t multiples = 0;
  for (int v = 0; v < depth.height; v += kStep) {
    for (int u = 0; u < depth.width; u += kStep) {
      const float z = metresAt(depth, u, v);
      if (!(z > 0.0F) || std::isinf(z)) continue;
      values.push_back(z);
      if (isMultipleOf5(depth, u, v)) ++multiples;
    }
  }
  DepthSpread spread;
  if (values.size() < kFewest) return spread;
  spread.known = true;
  spread.near = quantile(values, 0.1);
  spread.median = quantile(values, 0.5);
  spread.far = quantile(values, 0.95);
  spread.multiples_of_5 = multiples > values.size() / 100 * 99;
  return spread;
}

bool isPlausible(const DepthSpread& spread) {
  if (!spread.known) return true;
  if (spread.near < kNearest || spread.median < kNearestMost) return false;
  if (spread.median > kFarthest) return false;
  return !(spread.near > kNothingNear && spread.far > kFarthest) && !isFarInSteps(spread);
}

bool isFarInSteps(const DepthSpread& spread) {
  return spread.known && spread.near > kNothingNear && spread.multiples_of_5;
}

bool isImpossible(const DepthSpread& spread) {
  constexpr double kFar = 3.0;  // [-] beyond any doubt
  return spread.known && (spread.median > kFar * kFarthest || kFar * spread.median < kNearestMost);
}

}  // namespace dominant_plane_detection
