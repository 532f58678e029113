#include "calibration/depth_start_values.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace dominant_plane_detection {
namespace {

/// 1/Z = a + b D is linear.
std::vector<DepthConstants> reciprocalStarts(const std::vector<DepthPair>& pairs,
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
std::vector<DepthConstants> exponentialStarts(const std::vector<DepthPair>& pairs,
                                              const std::vector<double>& weights) {
  const auto [least, most] = std::minmax_element(
      pairs.begin(), pairs.end(), [](const auto& p, const auto& q) { return p.raw < q.raw; });
  const double middle = 0.5 * (least->raw + most->raw);
  const double span = most->raw - least->raw;
  std::vector<double> rates;  // [-] exponents over the whole span
  for (const double rate : {0.1, 0.3, 0.6, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0, 40.0}) {
    rates.insert(rates.end(), {rate, -rate});
  }
  std::vector<std::pair<double, DepthConstants>> starts;
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
  constexpr std::size_t kKept = 12;
  std::partial_sort(starts.begin(), starts.begin() + kKept, starts.end(),
                    [](const auto& s, const auto& t) { return s.first < t.first; });
  std::vector<DepthConstants> best;
  for (std::size_t i = 0; i < kKept; ++i) best.push_back(starts[i].second);
  return best;
}

}  // namespace

std::vector<DepthConstants> startValues(DepthCalibration::Form form,
                                        const std::vector<DepthPair>& pairs,
                                        const std::vector<double>& weights) {
  return form == DepthCalibration::Form::kExponential ? exponentialStarts(pairs, weights)
                                                      : reciprocalStarts(pairs, weights);
}

}  // namespace dominant_plane_detection
