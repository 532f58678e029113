#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/plane_moments.h"

namespace dominant_plane_detection {

/// Plane fits of one region with one more point each, all from a single decomposition of the
/// region's scatter.
///
/// In the region's eigenvectors, the scatter with a point r is diag(lambda) + rho z z^T with
/// z = V^T (r - g) and rho = k / (k + 1) (Eq. 10). Its smallest eigenvalue is lambda_1 + mu, where
/// mu is the smallest root of the secular equation
///   1 = rho (z_1^2 / mu - z_2^2 / (lambda_2 - lambda_1 - mu) - z_3^2 / (lambda_3 - lambda_1 -
///   mu)),
/// and the point's distance to the refitted plane is 1 / |(z_i / (lambda_i - lambda_1 - mu))_i|.
class PointRefit {
 public:
  struct Fit {
    double sum_squares;  ///< [m^2] smallest eigenvalue, the sum of squared distances to the plane
    double distance;     ///< [m] of the point to the plane
  };

  /// @param region of at least 3 points.
  void setRegion(const PlaneMoments& region);

  /// @return nothing where the equation is badly conditioned: where the point is exactly on the
  /// region's plane, or leaves the direction of the normal nearly open.
  std::optional<Fit> with(const Eigen::Vector3d& point) const;

  /// @return [-] of the region's plane, of either sign.
  Eigen::Vector3d normal() const { return vectors_.col(0); }
  /// @return [m^2] of the region's scatter, ascending.
  const Eigen::Vector3d& eigenvalues() const { return eigenvalues_; }
  /// @return [m^2] by which rounding may have changed any eigenvalue.
  double rounding() const { return kUlps * (eigenvalues_[2] + second_moment_); }

 private:
  static constexpr double kUlps = 1e-14;                   // some fifty units in the last place
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();       ///< [m]
  Eigen::Matrix3d vectors_ = Eigen::Matrix3d::Identity();  ///< in columns
  Eigen::Vector3d eigenvalues_ = Eigen::Vector3d::Zero();  ///< [m^2] ascending
  double second_moment_ = 0.0;                             ///< [m^2] k |g|^2
  double rho_ = 0.0;                                       ///< [-] k / (k + 1)
};

}  // namespace dominant_plane_detection
