#include "calibration/depth_fit.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>

namespace dominant_plane_detection {
namespace {

using Form = DepthCalibration::Form;
using Constants = std::array<double, 4>;

constexpr double kFarthest = 20.0;      // [m] that a tape measure is used for
constexpr double kConcordance = 0.85;   // [-] least share of pairs of pairs that ascend
constexpr double kOutlier = 4.0;        // [-] standard deviations
constexpr double kMostOutliers = 0.25;  // [-] share
constexpr double kMadToSigma = 1.4826;  // [-] of a normal distribution

DepthCalibration toCalibration(Form form, const double* c) {
  return form == Form::kExponential ? DepthCalibration{form, c[0], c[1], c[2], c[3]}
                                    : DepthCalibration{form, c[0], c[1], 0.0, 0.0};
}

Constants toConstants(const DepthCalibration& c) { return {c.a, c.b, c.c, c.d}; }

int countConstants(Form form) { return form == Form::kExponential ? 4 : 2; }

/// One pair's error in units of its standard deviation. Derivatives are numeric, so that the forms
/// stand in one place; constants of all sizes are solved for as multiples of their start values.
struct Residual {
  bool operator()(const double* multiples, double* residual) const {
    Constants constants = start;
    for (int i = 0; i < countConstants(form); ++i) {
      constants[static_cast<std::size_t>(i)] *= multiples[i];
    }
    const double z = toCalibration(form, constants.data()).evaluate(pair.raw);
    *residual = (z - pair.distance) / pair.sigma;
    return std::isfinite(z);
  }
  Form form;
  Constants start;
  DepthPair pair;
};

template <int kConstants>
ceres::CostFunction* costFunction(const Residual& residual) {
  return new ceres::NumericDiffCostFunction<Residual, ceres::CENTRAL, 1, kConstants>(
      new Residual(residual));
}

void build(ceres::Problem& problem, Form form, const std::vector<DepthPair>& pairs,
           const std::vector<double>& weights, const Constants& start, Constants& multiples) {
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
             Constants& constants) {
  ceres::Problem problem;
  Constants multiples;
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

/// 1/Z = a + b D is linear.
std::vector<Constants> reciprocalStarts(const std::vector<DepthPair>& pairs,
                                        const std::vector<double>& weights) {
  Eigen::MatrixX2d lines(pairs.size(), 2);
  Eigen::VectorXd values(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const DepthPair& p = pairs[i];
    const double weight = std::sqrt(weights[i]) * p.distance * p.distance / p.sigma;
    lines.row(static_cast<Eigen::Index>(i)) = weight * Eigen::RowVector2d(1.0, p.raw);
    values[static_cast<Eigen::Index>(i)] = weight / p.distance;
  }
  const Eigen::Vector2d ab = lines.colPivHouseholderQr().solve(values);
  return {{ab[0], ab[1], 0.0, 0.0}};
}

/// For given b and d, Z = a exp(b D) + c exp(d D) is linear in a and c: of many b and d those that
/// leave the smallest errors.
std::vector<Constants> exponentialStarts(const std::vector<DepthPair>& pairs,
                                         const std::vector<double>& weights) {
  const auto [least, most] = std::minmax_element(
      pairs.begin(), pairs.end(), [](const auto& p, const auto& q) { return p.raw < q.raw; });
  const double middle = 0.5 * (least->raw + most->raw);
  const double span = most->raw - least->raw;
  std::vector<double> rates;  // [-] exponents over the whole span
  for (const double rate : {0.1, 0.3, 0.6, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0, 40.0}) {
    rates.insert(rates.end(), {rate, -rate});
  }
  std::vector<std::pair<double, Constants>> starts;
  const auto n = static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixX2d lines(n, 2);
  Eigen::VectorXd values(n);
  for (const double first : rates) {
    for (const double second : rates) {
      if (first >= second) continue;
      const double b = second / span;
      const double d = first / span;
      for (Eigen::Index i = 0; i < n; ++i) {
        const DepthPair& p = pairs[static_cast<std::size_t>(i)];
        const double weight = std::sqrt(weights[static_cast<std::size_t>(i)]) / p.sigma;
        lines(i, 0) = weight * std::exp(b * (p.raw - middle));
        lines(i, 1) = weight * std::exp(d * (p.raw - middle));
        values[i] = weight * p.distance;
      }
      const Eigen::Vector2d ac = lines.colPivHouseholderQr().solve(values);
      starts.push_back({(lines * ac - values).squaredNorm(),
                        {ac[0] * std::exp(-b * middle), b, ac[1] * std::exp(-d * middle), d}});
    }
  }
  constexpr std::size_t kKept = 8;
  std::partial_sort(starts.begin(), starts.begin() + kKept, starts.end(),
                    [](const auto& s, const auto& t) { return s.first < t.first; });
  std::vector<Constants> best;
  for (std::size_t i = 0; i < kKept; ++i) best.push_back(starts[i].second);
  return best;
}

DepthCalibration fitWeighted(Form form, const std::vector<DepthPair>& pairs,
                             const std::vector<double>& weights) {
  double least = std::numeric_limits<double>::infinity();
  Constants best{};
  for (Constants constants : form == Form::kExponential ? exponentialStarts(pairs, weights)
                                                        : reciprocalStarts(pairs, weights)) {
    const double cost = solve(form, pairs, weights, constants);
    if (cost >= least) continue;
    least = cost;
    best = constants;
  }
  if (!std::isfinite(least)) {
    throw std::invalid_argument("the fit does not converge: the form does not describe the pairs");
  }
  return toCalibration(form, best.data());
}

/// [-] errors in units of their standard deviations.
std::vector<double> errorsOf(const DepthCalibration& calibration,
                             const std::vector<DepthPair>& pairs) {
  std::vector<double> errors;
  for (const DepthPair& p : pairs) {
    errors.push_back((calibration.evaluate(p.raw) - p.distance) / p.sigma);
  }
  return errors;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string describe(const DepthPair& p) {
  std::ostringstream text;
  text << "(raw " << p.raw << ", " << p.distance << " m)";
  return text.str();
}

void requireValues(const std::vector<DepthPair>& pairs) {
  for (const DepthPair& p : pairs) {
    if (!(0.0 <= p.raw && p.raw < 2047.0)) {
      throw std::invalid_argument("expected raw values from 0 to 2046 (2047 is no reading), got " +
                                  describe(p));
    }
    if (!(0.0 < p.distance && p.distance <= kFarthest)) {
      throw std::invalid_argument("expected distances in metres, up to " +
                                  std::to_string(static_cast<int>(kFarthest)) + " m, got " +
                                  describe(p));
    }
    if (!(0.0 <= p.sigma && std::isfinite(p.sigma))) {
      throw std::invalid_argument("expected standard deviations in metres, got one of " +
                                  std::to_string(p.sigma));
    }
  }
}

void requireEnough(const std::vector<DepthPair>& pairs, int constants) {
  std::set<double> raws;
  for (const DepthPair& p : pairs) raws.insert(p.raw);
  const int needed = constants + 1;
  if (static_cast<int>(raws.size()) >= needed) return;
  throw std::invalid_argument("too few pairs: expected at least " + std::to_string(needed) +
                              " different raw values for " + std::to_string(constants) +
                              " constants and their errors, got " + std::to_string(raws.size()));
}

void requireMonotonic(std::vector<DepthPair> pairs) {
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& p, const auto& q) { return p.raw < q.raw; });
  std::size_t compared = 0, ascending = 0;
  const DepthPair* first = nullptr;
  const DepthPair* second = nullptr;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t j = i + 1; j < pairs.size(); ++j) {
      if (pairs[i].raw == pairs[j].raw) continue;
      ++compared;
      if (pairs[i].distance < pairs[j].distance) {
        ++ascending;
      } else if (first == nullptr) {
        first = &pairs[i];
        second = &pairs[j];
      }
    }
  }
  if (static_cast<double>(ascending) >= kConcordance * static_cast<double>(compared)) return;
  throw std::invalid_argument(
      "the pairs are not monotonic: expected a distance that grows with the raw value, got " +
      describe(*first) + " and " + describe(*second) +
      "; are the columns in the order raw,distance?");
}

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
DepthCalibration fitRobust(Form form, const std::vector<DepthPair>& pairs) {
  std::vector<double> weights(pairs.size(), 1.0);
  DepthCalibration calibration = fitWeighted(form, pairs, weights);
  constexpr int kRounds = 20;
  for (int i = 0; i < kRounds; ++i) {
    const std::vector<double> errors = errorsOf(calibration, pairs);
    for (std::size_t k = 0; k < errors.size(); ++k) {
      weights[k] = 1.0 / std::max(std::abs(errors[k]), 0.1);
    }
    Constants constants = toConstants(calibration);
    solve(form, pairs, weights, constants);
    calibration = toCalibration(form, constants.data());
  }
  return calibration;
}

/// A robust fit, its pairs with the standard deviations that belong to it, and how large errors
/// are.
struct RobustFit {
  DepthCalibration calibration;
  std::vector<DepthPair> pairs;
  std::vector<double> sizes;  ///< [-] of the errors, in standard deviations
  double scale = 0.0;         ///< [-] robust standard deviation of the errors
};

RobustFit robustFit(Form form, const std::vector<DepthPair>& measured,
                    const DepthFitOptions& options) {
  RobustFit fit;
  fit.pairs = measured;
  for (DepthPair& p : fit.pairs) {
    if (p.sigma <= 0.0) p.sigma = options.distance_sigma * (1.0 + p.distance * p.distance);
  }
  constexpr int kRounds = 3;  // the slope of the curve changes little after the first
  for (int i = 0; i < kRounds; ++i) {
    fit.calibration = fitRobust(form, fit.pairs);
    fit.pairs = weighed(measured, options, fit.calibration);
  }
  fit.sizes = errorsOf(fit.calibration, fit.pairs);
  for (double& size : fit.sizes) size = std::abs(size);
  // Where errors are smaller than they are said to be, that is no reason to leave pairs out.
  fit.scale = std::max(kMadToSigma * median(fit.sizes), 1.0);
  return fit;
}

/// Weights of 0 for outliers, 1 for the rest. An outlier is what neither form explains: where the
/// form that is asked for does not describe the sensor, that is not the pairs' fault.
std::vector<double> findInliers(const RobustFit& asked, const std::vector<DepthPair>& measured,
                                const DepthFitOptions& options) {
  RobustFit best = asked;
  constexpr std::size_t kEnough = 10;
  if (measured.size() >= kEnough) {
    const bool exponential = options.form == Form::kExponential;
    const RobustFit other =
        robustFit(exponential ? Form::kReciprocal : Form::kExponential, measured, options);
    if (median(other.sizes) < median(best.sizes)) best = other;
  }
  std::vector<double> weights;
  for (const double size : best.sizes) weights.push_back(size <= kOutlier * best.scale ? 1.0 : 0.0);
  return weights;
}

void requireFew(const std::vector<DepthPair>& pairs, const std::vector<double>& weights) {
  const auto outliers = std::count(weights.begin(), weights.end(), 0.0);
  if (static_cast<double>(outliers) <= kMostOutliers * static_cast<double>(pairs.size())) return;
  const auto first = std::find(weights.begin(), weights.end(), 0.0) - weights.begin();
  throw std::invalid_argument(std::to_string(outliers) + " of " + std::to_string(pairs.size()) +
                              " pairs do not fit the others, such as " +
                              describe(pairs[static_cast<std::size_t>(first)]) +
                              ": measure them again");
}

DepthCalibration standardErrors(const DepthCalibration& calibration,
                                const std::vector<DepthPair>& pairs,
                                const std::vector<double>& weights) {
  const int n = countConstants(calibration.form);
  const Constants constants = toConstants(calibration);
  ceres::Problem problem;
  Constants multiples;
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
  // How large errors are is told by the residuals, better than by the tape's user.
  const double variance = squares / (count - n);
  Constants sigma{};
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    sigma[k] =
        std::abs(constants[k]) * std::sqrt(variance * block[k * static_cast<std::size_t>(n + 1)]);
  }
  return toCalibration(calibration.form, sigma.data());
}

/// Lawson's algorithm: weights grow where errors are large, until the largest are equal.
DepthCalibration fitMinimax(Form form, const std::vector<DepthPair>& pairs) {
  std::vector<double> weights(pairs.size(), 1.0 / static_cast<double>(pairs.size()));
  DepthCalibration calibration = fitWeighted(form, pairs, weights);
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
    Constants constants = toConstants(calibration);
    solve(form, pairs, weights, constants);
    calibration = toCalibration(form, constants.data());
  }
  return best;
}

}  // namespace

DepthFit fitDepth(const std::vector<DepthPair>& measured, const DepthFitOptions& options) {
  requireValues(measured);
  requireEnough(measured, countConstants(options.form));
  requireMonotonic(measured);
  DepthFit fit;
  const RobustFit robust = robustFit(options.form, measured, options);
  const std::vector<DepthPair>& pairs = robust.pairs;
  std::vector<double> weights(pairs.size(), 1.0);
  if (options.minimax) {
    fit.calibration = fitMinimax(options.form, pairs);
    fit.standard_errors.form = options.form;
  } else {
    weights = findInliers(robust, measured, options);
    requireFew(pairs, weights);
    fit.calibration = fitWeighted(options.form, pairs, weights);
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
