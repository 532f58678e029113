#include "dominant_plane_detection/camera_model.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace dominant_plane_detection {
namespace {

/// The distorted ray and its derivative by the undistorted one (plumb_bob is rational_polynomial
/// with k4 = k5 = k6 = 0).
struct Distorted {
  Eigen::Vector2d ray;
  Eigen::Matrix2d jacobian;
};

Distorted distort(const CameraModel& camera, const Eigen::Vector2d& ray) {
  if (camera.distortion == DistortionModel::kNone) return {ray, Eigen::Matrix2d::Identity()};
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6] = camera.coefficients;
  const double x = ray.x();
  const double y = ray.y();
  const double r2 = x * x + y * y;
  const double numerator = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double denominator = 1.0 + r2 * (k4 + r2 * (k5 + r2 * k6));
  const double radial = numerator / denominator;
  const double radial_by_r2 =
      (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3) - radial * (k4 + r2 * (2.0 * k5 + r2 * 3.0 * k6))) /
      denominator;
  Distorted result;
  result.ray = {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
                y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
  const double cross = 2.0 * x * y * radial_by_r2 + 2.0 * p1 * x + 2.0 * p2 * y;
  result.jacobian << radial + 2.0 * x * x * radial_by_r2 + 2.0 * p1 * y + 6.0 * p2 * x, cross,  //
      cross, radial + 2.0 * y * y * radial_by_r2 + 6.0 * p1 * y + 2.0 * p2 * x;
  return result;
}

}  // namespace

bool CameraModel::valid() const {
  bool finite = std::isfinite(fx) && std::isfinite(fy) && std::isfinite(cx) && std::isfinite(cy);
  for (const double coefficient : coefficients) finite = finite && std::isfinite(coefficient);
  return finite && width > 0 && height > 0 && fx > 0.0 && fy > 0.0;
}

Eigen::Vector2d CameraModel::project(const Eigen::Vector2d& ray) const {
  const Eigen::Vector2d distorted = distort(*this, ray).ray;
  return {fx * distorted.x() + cx, fy * distorted.y() + cy};
}

Eigen::Vector2d CameraModel::ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d target((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  if (distortion == DistortionModel::kNone) return target;
  constexpr int kMaxIterations = 30;
  constexpr double kTolerance = 1e-9;
  Eigen::Vector2d guess = target;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Distorted distorted = distort(*this, guess);
    const Eigen::Vector2d error = distorted.ray - target;
    // Where the jacobian turns over, several rays share a pixel: the calibration means nothing.
    if (!(distorted.jacobian.determinant() > 0.0)) break;
    if (error.norm() < kTolerance) return guess;
    guess -= distorted.jacobian.inverse() * error;
  }
  return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
}

bool CameraModel::operator==(const CameraModel& other) const {
  return width == other.width && height == other.height && fx == other.fx && fy == other.fy &&
         cx == other.cx && cy == other.cy && distortion == other.distortion &&
         coefficients == other.coefficients;
}

CameraModel paperCamera() {
  constexpr double kFocalLength = 4.98e-3;                   // [m] f
  constexpr double kPixelSize = 7.8e-6;                      // [m] rho_x, rho_y
  constexpr double kX0 = 2.76e-3, kY0 = 2.26e-3;             // [m] principal point offset
  constexpr double kDeltaX = 5.994e-6, kDeltaY = -7.027e-7;  // [m] lens distortion
  CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = kFocalLength / kPixelSize;
  camera.cx = (kX0 - kDeltaX) / kPixelSize;  // Eq. 2
  camera.cy = (kY0 - kDeltaY) / kPixelSize;  // Eq. 3
  return camera;
}

}  // namespace dominant_plane_detection
