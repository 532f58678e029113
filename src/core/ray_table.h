#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "dominant_plane_detection/camera_model.h"

namespace dominant_plane_detection {

/// Rays (X/Z, Y/Z) of every pixel, made once per camera: one value a column and one a row where the
/// lens is not distorted, one pair a pixel where it is.
class RayTable {
 public:
  /// Does nothing when the table is that of `camera` already.
  /// @pre camera.valid()
  void build(const CameraModel& camera);

  const CameraModel& camera() const { return camera_; }
  /// @return whether y is the same along each row, and x the same in every row.
  bool separable() const { return camera_.distortion == DistortionModel::kNone; }
  /// @return [-] X/Z of the pixels of row v, `camera().width` values.
  const float* x(int v) const { return separable() ? x_.data() : x_.data() + offset(v); }
  /// @return [-] Y/Z of the pixels of row v: one value if `separable()`, otherwise
  /// `camera().width` values.
  const float* y(int v) const { return separable() ? y_.data() + v : y_.data() + offset(v); }

  /// @return [-] (X/Z, Y/Z, 1) of pixel (u, v).
  Eigen::Vector3f ray(int u, int v) const { return {x(v)[u], y(v)[separable() ? 0 : u], 1.0F}; }

 private:
  std::size_t offset(int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(camera_.width);
  }

  CameraModel camera_;
  std::vector<float> x_;
  std::vector<float> y_;
};

}  // namespace dominant_plane_detection
