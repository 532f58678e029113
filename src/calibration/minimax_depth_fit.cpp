#include "calibration/minimax_depth_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/depth_least_squares.h"

namespace dominant_plane_detection {

/// Lawson's algorithm: weights grow where errors are large, until the largest are equal.
DepthCalibration fitMinimax(DepthCalibration::Form form, const std::vector<DepthPair>& pairs) {
  std::vector<double> weights(pairs.size(), 1.0 / static_cast<double>(pairs.size()));
  DepthCalibration calibration = fitLeastSquares(form, pairs, weights);
  DepthCalibration best = calibration;
  double least = std::numeric_limits<double>::infinity();
  constexpr int kRounds = 300;
  for (int i = 0; i < kRounds; ++i) {
    const std::vector<double> errors = errorsOf(calibration, pairs);
    double largest = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      largest = std::max(largest, std::abs(errors[k]));
      weights[k] *= std::abs(errors[k]);
      sum += weights[k];
    }
    if (largest < least) {
      least = largest;
      best = calibration;
    }
    for (double& weight : weights) weight /= sum;
    calibration = refit(calibration, pairs, weights);
  }
  return best;
}

}  // namespace dominant_plane_detection
