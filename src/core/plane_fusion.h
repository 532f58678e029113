#pragma once

#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/prior.h"

namespace dominant_plane_detection {

/// A plane with its covariance of [normal, distance], as `Detection` has them.
struct UncertainPlane {
  Eigen::Vector3d normal;  ///< [-] unit
  double distance;         ///< [m]
  Eigen::Matrix4d covariance;
};

/// Joins what is seen with what was predicted, by covariance intersection (S. Julier, J. Uhlmann,
/// ACC 1997): the information of either counts by its weight, and what comes out is no surer than
/// it may be however the two errors depend on each other. Errors of one sensor in successive images
/// do.
/// @return what is seen alone, where a covariance is unknown, the prediction has no weight, or the
/// two differ by more than their covariances explain (99 %).
UncertainPlane fuse(const UncertainPlane& seen, const Prior::PredictedPlane& predicted);

}  // namespace dominant_plane_detection
