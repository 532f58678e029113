#include "prior/plane_track.h"

#include <cmath>

namespace dominant_plane_detection {
namespace {

constexpr double kLongest = 0.5;  // [s]

/// @return what turns [normal, distance] in the camera's frame then into that in its frame now.
/// @param step T_then_now of the camera.
Eigen::Matrix4d changeBy(const Eigen::Isometry3d& step) {
  Eigen::Matrix4d change = Eigen::Matrix4d::Identity();
  change.topLeftCorner<3, 3>() = step.linear().transpose();
  change.bottomLeftCorner<1, 3>() = step.translation().transpose();
  return change;
}

}  // namespace

std::optional<double> PlaneTrack::stamp() const {
  return last_ ? std::make_optional(last_->stamp) : std::nullopt;
}

std::optional<Prior::PredictedPlane> PlaneTrack::predict(double stamp, const Motion& motion) const {
  const double since = last_ ? stamp - last_->stamp : -1.0;
  if (!(since >= 0.0 && since <= kLongest)) return std::nullopt;
  Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
  if (last_->camera && motion.camera) {
    step = last_->camera->inverse() * *motion.camera;
  } else if (motion.turn) {
    step.linear() = motion.turn->toRotationMatrix();
  }
  const Eigen::Matrix4d change = changeBy(step);
  Eigen::Vector4d plane;
  plane << last_->normal, last_->distance;
  plane = change * plane;
  Prior::PredictedPlane predicted{plane.head<3>().normalized(), plane[3]};
  // Behind the plane nothing can be seen of it.
  if (!(predicted.distance >= 0.0)) return std::nullopt;
  if (last_->covariance(0, 0) >= 0.0) {
    predicted.covariance = change * last_->covariance * change.transpose();
  }
  predicted.weight = smoothing_time_ > 0.0 ? std::exp(-since / smoothing_time_) : 0.0;
  // Two images of one stamp are no prediction of each other.
  if (!(predicted.weight < 1.0)) predicted.weight = 0.0;
  return predicted;
}

void PlaneTrack::add(double stamp, const Detection& detection,
                     const std::optional<Eigen::Isometry3d>& camera) {
  if (!detection.found()) return reset();
  last_ = Last{stamp, detection.normal, detection.distance, detection.covariance, camera};
}

}  // namespace dominant_plane_detection
