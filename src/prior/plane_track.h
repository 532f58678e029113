#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/prior.h"

namespace dominant_plane_detection {

/// Predicts the plane of an image from that of the one before.
class PlaneTrack {
 public:
  /// @param smoothing_time [s] after which an image counts 1/e in the result; 0: not at all.
  explicit PlaneTrack(double smoothing_time = 0.0) : smoothing_time_(smoothing_time) {}

  /// Where the camera was.
  struct Motion {
    /// T_base_camera in a frame that does not move over the plane.
    std::optional<Eigen::Isometry3d> camera;
    /// R_last_now of the camera; of no use where its pose is known at both images.
    std::optional<Eigen::Quaterniond> turn;
  };

  /// @param stamp [s] of the image to come.
  /// @return nothing after an image without a plane, after more than half a second, and when time
  /// went back.
  std::optional<Prior::PredictedPlane> predict(double stamp, const Motion& motion) const;
  void add(double stamp, const Detection& detection,
           const std::optional<Eigen::Isometry3d>& camera);
  void reset() { last_.reset(); }
  /// @return [s] of the last image, if it had a plane.
  std::optional<double> stamp() const;

 private:
  struct Last {
    double stamp;  ///< [s]
    Eigen::Vector3d normal;
    double distance;  ///< [m]
    Eigen::Matrix4d covariance;
    std::optional<Eigen::Isometry3d> camera;
  };

  double smoothing_time_;
  std::optional<Last> last_;
};

}  // namespace dominant_plane_detection
