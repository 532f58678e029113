#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace dominant_plane_detection {

/// [-] 95 % of squared Mahalanobis distances with three degrees of freedom are below.
constexpr double kChiSquare95 = 7.815;

/// @return [normal, distance] of one plane less another one's.
inline Eigen::Vector4d planeDifference(const Eigen::Vector3d& normal, double distance,
                                       const Eigen::Vector3d& other_normal, double other_distance) {
  Eigen::Vector4d difference;
  difference << normal - other_normal, distance - other_distance;
  return difference;
}

/// @param covariance of the difference, of rank 3: the direction that it knows least of, along the
/// normal, does not count.
/// @return [-] squared Mahalanobis distance.
inline double squaredMahalanobis(const Eigen::Matrix4d& covariance,
                                 const Eigen::Vector4d& difference) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(covariance);
  const Eigen::Vector4d along = solver.eigenvectors().transpose() * difference;
  double sum = 0.0;
  for (int i = 1; i < 4; ++i) sum += along[i] * along[i] / solver.eigenvalues()[i];
  return sum;
}

}  // namespace dominant_plane_detection
