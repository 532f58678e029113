#pragma once

#include <Eigen/Core>
#include <optional>

#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {

/// What is known about the plane of one image before looking; whatever is not given comes from the
/// parameters.
struct Prior {
  struct HeightRange {
    double min;  ///< [m]
    double max;  ///< [m]
  };
  struct ExpectedHeight {
    double height;     ///< [m]
    double tolerance;  ///< [m]
  };
  /// The plane where it should be now, from an earlier image.
  struct PredictedPlane {
    Eigen::Vector3d normal;  ///< [-] unit, as `Detection` has it
    double distance;         ///< [m] >= 0
    /// Of [normal, distance]; needed only where it has a weight.
    Eigen::Matrix4d covariance = unknownCovariance();
    /// [-] 0 to below 1: how much of the result is the prediction, what is seen being the rest.
    double weight = 0.0;
  };

  std::optional<Eigen::Vector3d> expected_up;  ///< [-] in the optical frame, of any length
  UpSource up_source = UpSource::kNone;        ///< where expected_up came from
  double up_error = 0.175;  ///< [rad] by which it may be wrong; 10 degrees, as of a mount
  std::optional<HeightRange> height_range;  ///< [m] camera height over the plane; others are none
  /// [m] Planes at this height come before others, which come as `Parameters::prefer` says.
  std::optional<ExpectedHeight> expected_height;
  /// Is looked for first (grid only), and holds if nothing better can be left. What is predicted
  /// wrongly costs time, no more.
  std::optional<PredictedPlane> predicted_plane;
};

}  // namespace dominant_plane_detection
