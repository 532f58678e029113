#include "calibration/depth_least_squares.h"

#include <ceres/ceres.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "calibration/depth_start_values.h"

namespace dominant_plane_detection {
namespace {

using Form = DepthCalibration::Form;

/// One pair's error in units of its standard deviation. Derivatives are numeric, so that the forms
/// stand in one place; constants of all sizes are solved for as multiples of their start values.
struct Residual {
  bool operator()(const double* multiples, double* residual) const {
    DepthConstants constants = start;
    for (int i = 0; i < countConstants(form); ++i) {
      constants[static_cast<std::size_t>(i)] *= multiples[i];
    }
    const double z = toCalibration(form, constants).evaluate(pair.raw);
    // What leaves the numbers is a step too far, which the solver takes back.
    constexpr double kTooFar = 1e9;
    *residual = std::isfinite(z) ? (z - pair.distance) / pair.sigma : kTooFar;
    return true;
  }
  Form form;
  DepthConstants start;
  DepthPair pair;
};

template <int kConstants>
ceres::CostFunction* costFunction(const Residual& residual) {
  return new ceres::NumericDiffCostFunction<Residual, ceres::CENTRAL, 1, kConstants>(
      new Residual(residual));
}

void build(ceres::Problem& problem, Form form, const std::vector<DepthPair>& pairs,
           const std::vector<double>& weights, const DepthConstants& start,
           DepthConstants& multiples) {
  multiples.fill(1.0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (weights[i] <= 0.0) continue;
    const Residual residual{form, start, pairs[i]};
    auto* const cost =
        form == Form::kExponential ? costFunction<4>(residual) : costFunction<2>(residual);
    auto* const loss = new ceres::ScaledLoss(nullptr, weights[i], ceres::TAKE_OWNERSHIP);
    problem.AddResidualBlock(cost, loss, multiples.data());
  }
}

/// @return half the weighted sum of squares at the minimum that is reached from `constants`;
/// infinite when there is none.
double solve(Form form, const std::vector<DepthPair>& pairs, const std::vector<double>& weights,
             DepthConstants& constants) {
  ceres::Problem problem;
  DepthConstants multiples;
  build(problem, form, pairs, weights, constants, multiples);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 500;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (std::size_t i = 0; i < constants.size(); ++i) constants[i] *= multiples[i];
  return summary.IsSolutionUsable() ? summary.final_cost : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<double> errorsOf(const DepthCalibration& calibration,
                             const std::vector<DepthPair>& pairs) {
  std::vector<double> errors;
  for (const DepthPair& p : pairs) {
    errors.push_back((calibration.evaluate(p.raw) - p.distance) / p.sigma);
  }
  return errors;
}

DepthCalibration fitLeastSquares(Form form, const std::vector<DepthPair>& pairs,
                                 const std::vector<double>& weights) {
  double least = std::numeric_limits<double>::infinity();
  DepthConstants best{};
  for (DepthConstants constants : startValues(form, pairs, weights)) {
    const double cost = solve(form, pairs, weights, constants);
    if (cost >= least) continue;
    least = cost;
    best = constants;
  }
  if (!std::isfinite(least)) {
    throw std::invalid_argument("the fit does not converge: the form does not describe the pairs");
  }
  return toCalibration(form, best);
}

DepthCalibration refit(const DepthCalibration& start, const std::vector<DepthPair>& pairs,
                       const std::vector<double>& weights) {
  DepthConstants constants = toConstants(start);
  solve(start.form, pairs, weights, constants);
  return toCalibration(start.form, constants);
}

DepthCalibration standardErrors(const DepthCalibration& calibration,
                                const std::vector<DepthPair>& pairs,
                                const std::vector<double>& weights) {
  const int n = countConstants(calibration.form);
  const DepthConstants constants = toConstants(calibration);
  ceres::Problem problem;
  DepthConstants multiples;
  build(problem, calibration.form, pairs, weights, constants, multiples);
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.null_space_rank = -1;  // constants that the pairs do not tell apart
  ceres::Covariance covariance(options);
  const std::vector<std::pair<const double*, const double*>> wanted = {
      {multiples.data(), multiples.data()}};
  if (!covariance.Compute(wanted, &problem)) return {};
  std::vector<double> block(static_cast<std::size_t>(n * n));
  covariance.GetCovarianceBlock(multiples.data(), multiples.data(), block.data());
  double squares = 0.0, count = 0.0;
  const std::vector<double> errors = errorsOf(calibration, pairs);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    squares += weights[i] * errors[i] * errors[i];
    count += weights[i];
  }
  // How large errors are is told by the residuals, better than by the tape's user; the fewer they
  // are the less they know, and the wider the interval is that holds the truth in 68 of 100 fits.
  const double freedom = count - n;
  if (freedom < 1.0) {  // as many constants as pairs: nothing is left to judge them by
    DepthCalibration unknown;
    unknown.form = calibration.form;
    return unknown;
  }
  const double sigma_share = 0.5 * (1.0 + std::erf(std::sqrt(0.5)));  // below one sigma
  const double width = boost::math::quantile(boost::math::students_t(freedom), sigma_share);
  const double variance = squares / freedom * width * width;
  DepthConstants sigma{};
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    sigma[k] =
        std::abs(constants[k]) * std::sqrt(variance * block[k * static_cast<std::size_t>(n + 1)]);
  }
  return toCalibration(calibration.form, sigma);
}

}  // namespace dominant_plane_detection
