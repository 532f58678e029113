#include "support/scoring.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/ray_table.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {
namespace {

struct Overlap {
  std::size_t both = 0;
  std::size_t either = 0;

  void add(bool a, bool b) {
    both += a && b;
    either += a || b;
  }
  double ratio() const {
    return either == 0 ? 1.0 : static_cast<double>(both) / static_cast<double>(either);
  }
};

}  // namespace

Score score(const Detection& detection, const ReferenceSet& set, const ReferenceImage& truth) {
  Score result;
  result.found = detection.found();
  if (result.found) {
    result.angle = std::acos(std::clamp(detection.normal.dot(truth.up), -1.0, 1.0));
    result.height = std::abs(detection.distance - truth.height);
  }
  RayTable rays;
  rays.build(set.camera);
  const NoiseModel noise{0.002, 1.425e-3};
  Overlap decided, plain;
  for (int v = 0; v < truth.depth.rows; ++v) {
    for (int u = 0; u < truth.depth.cols; ++u) {
      const double z = static_cast<double>(metresAt(set.view(truth), u, v));
      if (z < set.range_min || z > set.range_max) continue;
      const bool found = detection.label(u, v) == Label::kGround;
      const bool ground = truth.ground.at<std::uint8_t>(v, u) == 255;
      plain.add(found, ground);
      const double height = z * truth.up.dot(rays.ray(u, v).cast<double>()) + truth.height;
      const double sigmas = std::abs(height) / noise.sigma(z);
      if (sigmas <= 1.0 || sigmas >= 5.0) decided.add(found, ground);
    }
  }
  result.iou = decided.ratio();
  result.plain_iou = plain.ratio();
  return result;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double position = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (position - static_cast<double>(below)) * (values[above] - values[below]);
}

Summary summarize(const std::vector<Score>& scores) {
  Summary summary;
  summary.images = scores.size();
  std::vector<double> iou, plain, angle, height, ms;
  for (const Score& score : scores) {
    summary.failures += score.failed();
    iou.push_back(score.iou);
    plain.push_back(score.plain_iou);
    ms.push_back(score.ms);
    if (!score.found) continue;
    angle.push_back(score.angle);
    height.push_back(score.height);
  }
  summary.iou_median = quantile(iou, 0.5);
  summary.iou_p10 = quantile(iou, 0.1);
  summary.plain_iou_median = quantile(plain, 0.5);
  summary.plain_iou_p10 = quantile(plain, 0.1);
  summary.angle_median = quantile(angle, 0.5);
  summary.angle_p90 = quantile(angle, 0.9);
  summary.height_median = quantile(height, 0.5);
  summary.height_p90 = quantile(height, 0.9);
  summary.ms_median = quantile(ms, 0.5);
  return summary;
}

double groundOverlap(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  constexpr auto kGround = static_cast<std::uint8_t>(Label::kGround);
  Overlap overlap;
  for (std::size_t i = 0; i < a.size(); ++i) overlap.add(a[i] == kGround, b[i] == kGround);
  return overlap.ratio();
}

}  // namespace dominant_plane_detection
