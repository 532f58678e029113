#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/hesse_plane.h"

namespace dominant_plane_detection {

/// The plane fitted to a set of points, and how well it fits.
struct PlaneFit {
  HessePlane plane;
  Eigen::Vector3d centre;       ///< [m] r_g (Eq. 6)
  Eigen::Vector3d eigenvalues;  ///< [m^2] of the scatter A, ascending
  double mean_square_error;     ///< [m^2] lambda_min / k (Eq. 8, 9)
};

/// Zeroth, first and second moments of a set of points: all that a plane fit needs of them.
///
/// Points and sets add in any order. The scatter about the centre is A = sum r r^T - r_g s^T, so
/// adding to the second moment is Eq. 10 with its terms r_g s^T moved to the other side. The sums
/// are double: with points several metres from the origin, float would lose the plane's thickness.
class PlaneMoments {
 public:
  /// @param point [m]
  /// @param weight [-] > 0; 1 is the paper's sum, 1/sigma^2 makes the fit noise-weighted.
  void add(const Eigen::Vector3d& point, double weight = 1.0) {
    count_ += weight;
    sum_ += weight * point;
    second_moment_.noalias() += weight * point * point.transpose();
  }

  /// Adds `count` points at once.
  /// @param centre [m] their mean.
  /// @param scatter [m^2] sum of (r - centre)(r - centre)^T over them.
  /// @param weight [-] of each of the points.
  void add(double count, const Eigen::Vector3d& centre, const Eigen::Matrix3d& scatter,
           double weight = 1.0) {
    count_ += weight * count;
    sum_ += weight * count * centre;
    second_moment_.noalias() += weight * (scatter + count * centre * centre.transpose());
  }

  void merge(const PlaneMoments& other) {
    count_ += other.count_;
    sum_ += other.sum_;
    second_moment_ += other.second_moment_;
  }

  double count() const { return count_; }                   ///< k, or the sum of the weights
  const Eigen::Vector3d& sum() const { return sum_; }       ///< [m] s
  Eigen::Vector3d centre() const { return sum_ / count_; }  ///< [m] r_g (Eq. 6)
  Eigen::Matrix3d scatter() const {                         ///< [m^2] A (Eq. 5)
    return second_moment_ - centre() * sum_.transpose();
  }

  /// The plane of least mean square error (Eq. 4 to 9).
  /// @return nothing for fewer than 3 points, and for points on a line or in one place: there the
  /// normal is not determined.
  std::optional<PlaneFit> fit() const;

 private:
  double count_ = 0.0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_moment_ = Eigen::Matrix3d::Zero();
};

}  // namespace dominant_plane_detection
