#include "core/tile_limits.h"

#include <cmath>

namespace dominant_plane_detection {

void TileLimits::set(const TileMoments& tiles, const GrowthThresholds& thresholds) {
  const std::size_t size = tiles.count.size();
  for (auto* values : {&delta, &epsilon2, &gamma, &inverse_sigma, &radius}) values->resize(size);
  const auto constant = static_cast<float>(thresholds.noise.constant);
  const auto quadratic = static_cast<float>(thresholds.noise.quadratic);
  const auto at = [](const DepthThreshold& threshold, float sigma) {
    return static_cast<float>(threshold.offset) + static_cast<float>(threshold.sigmas) * sigma;
  };
  for (std::size_t tile = 0; tile < size; ++tile) {
    const float sigma = constant + quadratic * tiles.z[tile] * tiles.z[tile];
    const float epsilon = at(thresholds.epsilon, sigma);
    delta[tile] = at(thresholds.delta, sigma);
    epsilon2[tile] = epsilon * epsilon;
    gamma[tile] = at(thresholds.gamma, sigma);
    inverse_sigma[tile] = 1.0F / sigma;
    // Points spread evenly over a length have a variance of a third of its half squared.
    radius[tile] = std::sqrt(3.0F * (tiles.xx[tile] + tiles.yy[tile] + tiles.zz[tile]));
  }
}

}  // namespace dominant_plane_detection
