#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace dominant_plane_detection {

enum class DistortionModel : std::uint8_t { kNone, kPlumbBob, kRationalPolynomial };

/// A pinhole camera with lens distortion, in the optical frame of REP 103 (x right, y down,
/// z forward): a point (X, Y, Z) is seen at u = fx x'' + cx, v = fy y'' + cy, where (x'', y'') is
/// the distorted (X/Z, Y/Z).
///
/// Eq. 2 and 3 are the same pinhole with fx = f / rho, cx = (x0 - delta_x) / rho; their minus signs
/// turn the frame by pi about the optical axis.
struct CameraModel {
  int width = 0;    ///< [px]
  int height = 0;   ///< [px]
  double fx = 0.0;  ///< [px]
  double fy = 0.0;  ///< [px]
  double cx = 0.0;  ///< [px]
  double cy = 0.0;  ///< [px]
  DistortionModel distortion = DistortionModel::kNone;
  /// [-] k1 k2 p1 p2 k3 (plumb_bob), followed by k4 k5 k6 (rational_polynomial)
  std::array<double, 8> coefficients{};

  /// @return whether the numbers can be a camera: sizes and focal lengths finite and positive,
  /// everything else finite.
  bool valid() const;

  /// @param ray [-] (X/Z, Y/Z) of a point.
  /// @return [px] where the camera sees it.
  Eigen::Vector2d project(const Eigen::Vector2d& ray) const;

  /// Inverse of `project`, by Newton's method from the undistorted guess.
  /// @param pixel [px]
  /// @return [-] (X/Z, Y/Z); NaN where the distortion model cannot be inverted (beyond the radius
  /// to which a calibration is meaningful).
  Eigen::Vector2d ray(const Eigen::Vector2d& pixel) const;

  bool operator==(const CameraModel& other) const;
  bool operator!=(const CameraModel& other) const { return !(*this == other); }
};

/// The infrared camera of Table I, for comparison with the paper; its principal point lies 50 px
/// below the middle of the image, so it is no default for a real Kinect.
CameraModel paperCamera();

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
