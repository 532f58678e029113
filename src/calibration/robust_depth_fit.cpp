#include "calibration/robust_depth_fit.h"

#include <algorithm>
#include <cmath>

#include "calibration/depth_least_squares.h"
#include "calibration/median.h"

namespace dominant_plane_detection {
namespace {

using Form = DepthCalibration::Form;

constexpr double kOutlier = 4.0;        // [-] standard deviations
constexpr double kMadToSigma = 1.4826;  // [-] of a normal distribution

/// Gives every pair its standard deviation: that of the tape, and that of the raw value by the
/// slope of the curve. Pairs that bring one of their own keep it.
std::vector<DepthPair> weighed(std::vector<DepthPair> pairs, const DepthFitOptions& options,
                               const DepthCalibration& curve) {
  for (DepthPair& p : pairs) {
    if (p.sigma > 0.0) continue;
    const double slope = std::abs(curve.evaluate(p.raw + 0.5) - curve.evaluate(p.raw - 0.5));
    p.sigma = std::hypot(options.distance_sigma, slope * options.raw_sigma);
  }
  return pairs;
}

/// A fit that a few pairs far off do not move: least absolute errors, by weights.
DepthCalibration fitLeastAbsolute(Form form, const std::vector<DepthPair>& pairs) {
  std::vector<double> weights(pairs.size(), 1.0);
  DepthCalibration calibration = fitLeastSquares(form, pairs, weights);
  constexpr int kRounds = 20;
  for (int i = 0; i < kRounds; ++i) {
    const std::vector<double> errors = errorsOf(calibration, pairs);
    for (std::size_t k = 0; k < errors.size(); ++k) {
      weights[k] = 1.0 / std::max(std::abs(errors[k]), 0.1);
    }
    calibration = refit(calibration, pairs, weights);
  }
  return calibration;
}

}  // namespace

RobustDepthFit fitRobustly(Form form, const std::vector<DepthPair>& measured,
                           const DepthFitOptions& options) {
  RobustDepthFit fit;
  fit.pairs = measured;
  for (DepthPair& p : fit.pairs) {
    if (p.sigma <= 0.0) p.sigma = options.distance_sigma * (1.0 + p.distance * p.distance);
  }
  constexpr int kRounds = 3;  // the slope of the curve changes little after the first
  for (int i = 0; i < kRounds; ++i) {
    fit.calibration = fitLeastAbsolute(form, fit.pairs);
    fit.pairs = weighed(measured, options, fit.calibration);
  }
  fit.sizes = errorsOf(fit.calibration, fit.pairs);
  for (double& size : fit.sizes) size = std::abs(size);
  // Where errors are smaller than they are said to be, that is no reason to leave pairs out.
  fit.scale = std::max(kMadToSigma * median(fit.sizes), 1.0);
  return fit;
}

std::vector<double> findInliers(const RobustDepthFit& asked, const std::vector<DepthPair>& measured,
                                const DepthFitOptions& options) {
  // A curve with many constants has many minima, and few pairs hold the least absolute errors in a
  // poor one. Where least squares explain all pairs there are no outliers to look for.
  const std::vector<double> all(measured.size(), 1.0);
  const std::vector<double> plain =
      errorsOf(fitLeastSquares(options.form, asked.pairs, all), asked.pairs);
  if (std::all_of(plain.begin(), plain.end(), [](double e) { return std::abs(e) <= kOutlier; })) {
    return all;
  }
  RobustDepthFit best = asked;
  constexpr std::size_t kEnough = 10;
  if (measured.size() >= kEnough) {
    const bool exponential = options.form == Form::kExponential;
    const RobustDepthFit other =
        fitRobustly(exponential ? Form::kReciprocal : Form::kExponential, measured, options);
    if (median(other.sizes) < median(best.sizes)) best = other;
  }
  std::vector<double> weights;
  for (const double size : best.sizes) weights.push_back(size <= kOutlier * best.scale ? 1.0 : 0.0);
  return weights;
}

}  // namespace dominant_plane_detection
