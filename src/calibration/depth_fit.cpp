#include "calibration/depth_fit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "calibration/depth_least_squares.h"
#include "calibration/minimax_depth_fit.h"
#include "calibration/robust_depth_fit.h"

namespace dominant_plane_detection {
namespace {

constexpr double kMostOutliers = 0.25;  // [-] share

void requireFew(const std::vector<DepthPair>& pairs, const std::vector<double>& weights) {
  const auto outliers = std::count(weights.begin(), weights.end(), 0.0);
  if (static_cast<double>(outliers) <= kMostOutliers * static_cast<double>(pairs.size())) return;
  const auto first = std::find(weights.begin(), weights.end(), 0.0) - weights.begin();
  throw std::invalid_argument(std::to_string(outliers) + " of " + std::to_string(pairs.size()) +
                              " pairs do not fit the others, such as " +
                              describe(pairs[static_cast<std::size_t>(first)]) +
                              ": measure them again");
}

}  // namespace

DepthFit fitDepth(const std::vector<DepthPair>& measured, const DepthFitOptions& options) {
  requireUsable(measured, countConstants(options.form));
  DepthFit fit;
  const RobustDepthFit robust = fitRobustly(options.form, measured, options);
  const std::vector<DepthPair>& pairs = robust.pairs;
  std::vector<double> weights(pairs.size(), 1.0);
  if (options.minimax) {
    fit.calibration = fitMinimax(options.form, pairs);
    fit.standard_errors.form = options.form;
  } else {
    weights = findInliers(robust, measured, options);
    requireFew(pairs, weights);
    fit.calibration = fitLeastSquares(options.form, pairs, weights);
    fit.standard_errors = standardErrors(fit.calibration, pairs, weights);
  }
  double squares = 0.0, errors = 0.0, count = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double residual = fit.calibration.evaluate(pairs[i].raw) - pairs[i].distance;
    fit.residuals.push_back(residual);
    fit.outliers.push_back(weights[i] == 0.0);
    if (weights[i] == 0.0) continue;
    squares += residual * residual;
    errors += residual * residual / (pairs[i].sigma * pairs[i].sigma);
    count += 1.0;
    fit.worst = std::max(fit.worst, std::abs(residual));
  }
  fit.rms = std::sqrt(squares / count);
  fit.sigmas = std::sqrt(errors / count);
  return fit;
}

}  // namespace dominant_plane_detection
