#include "core/plane_fusion.h"

#include <Eigen/LU>

#include "core/hesse_plane.h"

namespace dominant_plane_detection {
namespace {

/// [-] of chi squared with three degrees of freedom: 99 %.
constexpr double kGate = 11.34;

}  // namespace

UncertainPlane fuse(const UncertainPlane& seen, const Prior::PredictedPlane& predicted) {
  const bool known = seen.covariance(0, 0) >= 0.0 && predicted.covariance(0, 0) >= 0.0;
  if (!known || !(predicted.weight > 0.0)) return seen;
  const Eigen::Matrix<double, 3, 4> across = planeChanges(seen.normal).transpose();
  Eigen::Vector4d apart;
  apart << predicted.normal - seen.normal, predicted.distance - seen.distance;
  const Eigen::Vector3d change = across * apart;
  const Eigen::Matrix3d ours = across * seen.covariance * across.transpose();
  const Eigen::Matrix3d theirs = across * predicted.covariance * across.transpose();
  if (!(change.dot((ours + theirs).inverse() * change) < kGate)) return seen;

  const double weight = predicted.weight;
  const Eigen::Matrix3d their_information = weight * theirs.inverse();
  const Eigen::Matrix3d covariance =
      ((1.0 - weight) * ours.inverse() + their_information).inverse();
  const Eigen::Vector3d step = covariance * their_information * change;
  const Eigen::Vector4d moved = across.transpose() * step;
  UncertainPlane fused;
  fused.normal = (seen.normal + moved.head<3>()).normalized();
  fused.distance = seen.distance + moved[3];
  const Eigen::Matrix<double, 3, 4> again = planeChanges(fused.normal).transpose();
  // The axes across the two normals differ by a turn about them.
  const Eigen::Matrix3d turn = again * across.transpose();
  fused.covariance = again.transpose() * turn * covariance * turn.transpose() * again;
  return fused;
}

}  // namespace dominant_plane_detection
