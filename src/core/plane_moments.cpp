#include "core/plane_moments.h"

#include <Eigen/Eigenvalues>

namespace dominant_plane_detection {

std::optional<PlaneFit> PlaneMoments::fit() const {
  if (!(count_ > 0.0)) return std::nullopt;
  const Eigen::Matrix3d a = scatter();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(a);
  const Eigen::Vector3d& eigenvalues = solver.eigenvalues();
  // On a line, and for fewer than 3 points, the second eigenvalue is what rounding leaves of 0.
  constexpr double kRounding = 1e-12;
  if (!(eigenvalues[1] > kRounding * second_moment_.trace())) return std::nullopt;

  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  const Eigen::Vector3d r_g = centre();
  // n^T A n rather than the eigenvalue: the same number, but never negative for a perfect plane.
  const double mean_square_error = std::max(0.0, normal.dot(a * normal)) / count_;  // Eq. 8, 9
  return PlaneFit{HessePlane::through(r_g, normal), r_g, eigenvalues, mean_square_error};  // Eq. 7
}

}  // namespace dominant_plane_detection
