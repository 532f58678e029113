#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

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

}  // namespace dominant_plane_detection
