#include "core/point_refit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace dominant_plane_detection {

void PointRefit::setRegion(const PlaneMoments& region) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(region.scatter());
  vectors_ = solver.eigenvectors();
  eigenvalues_ = solver.eigenvalues();
  centre_ = region.centre();
  second_moment_ = region.count() * centre_.squaredNorm();
  rho_ = region.count() / (region.count() + 1.0);
}

std::optional<PointRefit::Fit> PointRefit::with(const Eigen::Vector3d& point) const {
  const Eigen::Array3d z2 = (vectors_.transpose() * (point - centre_)).array().square();
  const Eigen::Array2d gaps = eigenvalues_.tail<2>().array() - eigenvalues_[0];
  const double height2 = rho_ * z2[0];
  // Without z_3 the equation is a quadratic one, and its root is an upper bound.
  const double b = gaps[0] + rho_ * (z2[0] + z2[1]), c = height2 * gaps[0];
  double mu = 2.0 * c / (b + std::sqrt(std::max(0.0, b * b - 4.0 * c)));
  constexpr double kWellConditioned = 1e6;
  if (!(mu > 0.0 && gaps[0] - mu > kWellConditioned * rounding())) return std::nullopt;
  // Newton's method on mu + rho sum z_i^2 mu / (gap_i - mu) - rho z_1^2, which is increasing and
  // convex: from above it comes down to the root and never passes it.
  constexpr int kMostSteps = 20;
  constexpr double kPrecise = 1e-12;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Array2d rest = gaps - mu;
    const Eigen::Array2d terms = rho_ * z2.tail<2>() / rest;
    const double value = mu * (1.0 + terms.sum()) - height2;
    const double slope = 1.0 + (terms * gaps / rest).sum();
    mu -= value / slope;
    if (value > kPrecise * height2) continue;
    const double inverse2 = z2[0] / (mu * mu) + (z2.tail<2>() / (gaps - mu).square()).sum();
    return Fit{eigenvalues_[0] + mu, 1.0 / std::sqrt(inverse2)};
  }
  return std::nullopt;
}

}  // namespace dominant_plane_detection
