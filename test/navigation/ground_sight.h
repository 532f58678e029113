#pragma once

#include <cmath>

#include "core/ray_table.h"
#include "dominant_plane_detection/detection.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {

constexpr double kDegree = M_PI / 180.0;
constexpr double kSightHeight = 0.6;  // [m] of the camera

/// What a camera sees of the floor and of a post, by own arithmetic: pixels whose ray hits the
/// upright cylinder about the post before the floor.
class GroundSight {
 public:
  GroundSight(double pitch, double roll, CameraModel camera = testCamera())
      : camera_(camera), up_(upOf(pitch, roll)), depth_(planeDepth(camera, up_, kSightHeight)) {
    rays_.build(camera_);
    detection_.state = State::kFound;
    detection_.normal = up_;
    detection_.distance = kSightHeight;
    detection_.image_width = camera_.width;
    detection_.image_height = camera_.height;
    detection_.labels.assign(depth_.pixels.size(), 0);
    for (std::size_t i = 0; i < depth_.pixels.size(); ++i) {
      const bool near = depth_.pixels[i] > 0.0F && depth_.pixels[i] < 4.0F;
      detection_.labels[i] = static_cast<std::uint8_t>(near ? Label::kGround : Label::kUnknown);
    }
    const Eigen::Vector3d view = Eigen::Vector3d::UnitZ() - up_.z() * up_;
    ahead_ = view.normalized();
    left_ = up_.cross(ahead_);
  }

  /// A post as wide as the beam of an angle, from the ground up.
  /// @param direction [rad] > 0 left. @param range [m] of its face from the camera's foot.
  void addPost(double direction, double range, double low, double high,
               Label label = Label::kObstacle) {
    forEachPixel([&](std::size_t i, const Eigen::Vector3d& ray) {
      const double forward = ray.dot(ahead_), sideways = ray.dot(left_), upward = ray.dot(up_);
      const double along = std::hypot(forward, sideways);
      const double z = range / along, height = kSightHeight + z * upward;
      const double off = std::atan2(sideways, forward) - direction;
      if (std::abs(off) > 1.5 * kDegree || height < low || height > high) return;
      depth_.pixels[i] = static_cast<float>(z);
      detection_.labels[i] = static_cast<std::uint8_t>(label);
    });
  }
  /// Labels what is on the floor in a direction, beyond a range.
  void mark(double direction, double range, Label label) {
    forEachPixel([&](std::size_t i, const Eigen::Vector3d& ray) {
      const double forward = ray.dot(ahead_), sideways = ray.dot(left_), upward = ray.dot(up_);
      if (!(upward < 0.0)) return;
      const double off = std::atan2(sideways, forward) - direction;
      const double at = -kSightHeight / upward * std::hypot(forward, sideways);
      if (std::abs(off) > 1.5 * kDegree || at < range) return;
      detection_.labels[i] = static_cast<std::uint8_t>(label);
    });
  }

  /// A box with its sides along those of the frame on the ground, before what is farther away.
  /// @param low, high [m] two corners in that frame.
  void addBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    Eigen::Matrix3d axes;
    axes << ahead_.transpose(), left_.transpose(), up_.transpose();
    forEachPixel([&](std::size_t i, const Eigen::Vector3d& ray) {
      const Eigen::Vector3d along = axes * ray, camera(0.0, 0.0, kSightHeight);
      const Eigen::Array3d a = (low - camera).array() / along.array();
      const Eigen::Array3d b = (high - camera).array() / along.array();
      const double enters = a.min(b).maxCoeff(), leaves = a.max(b).minCoeff();
      const double before = static_cast<double>(depth_.pixels[i]);
      if (!(enters > 0.0 && enters < leaves) || (before > 0.0 && before < enters)) return;
      depth_.pixels[i] = static_cast<float>(enters);
      detection_.labels[i] = static_cast<std::uint8_t>(Label::kObstacle);
    });
  }
  /// Changes each pixel. @param change called with its place (forward, left) on the floor [m], its
  /// depth [m] and its label.
  template <typename Change>
  void changeFloor(Change&& change) {
    forEachPixel([&](std::size_t i, const Eigen::Vector3d& ray) {
      const double upward = ray.dot(up_);
      if (!(upward < 0.0)) return;
      const double z = -kSightHeight / upward;
      change(Eigen::Vector2d(z * ray.dot(ahead_), z * ray.dot(left_)), depth_.pixels[i],
             detection_.labels[i]);
    });
  }

  const OwnedDepth<float>& metres() const { return depth_; }
  DepthView depth() const { return depth_.view(); }
  const RayTable& rays() const { return rays_; }
  Detection& detection() { return detection_; }

 private:
  template <typename Visit>
  void forEachPixel(Visit&& visit) {
    for (int v = 0; v < camera_.height; ++v) {
      for (int u = 0; u < camera_.width; ++u) {
        visit(detection_.indexOf(u, v), rays_.ray(u, v).cast<double>());
      }
    }
  }

  CameraModel camera_;
  Eigen::Vector3d up_, ahead_, left_;
  OwnedDepth<float> depth_;
  RayTable rays_;
  Detection detection_;
};

}  // namespace dominant_plane_detection
