// The renderer's rays and the core's, made by different arithmetic, against each other.

#include "synthetic/camera_rays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/ray_table.h"
#include "synthetic/scene.h"

namespace dominant_plane_detection {
namespace {

CameraModel distorted(DistortionModel model, const std::array<double, 8>& coefficients) {
  CameraModel camera = kinectCamera();
  camera.cx = 325.1;  // not in the middle
  camera.fy = 582.3;  // not square
  camera.distortion = model;
  camera.coefficients = coefficients;
  return camera;
}

struct Agreement {
  std::size_t both = 0;     ///< [px] with a ray by both
  std::size_t neither = 0;  ///< [px]
  double worst = 0.0;       ///< [px] between the two rays
};

Agreement compare(const CameraModel& camera) {
  RayTable table;
  table.build(camera);
  const auto rays = cameraRays(camera);
  Agreement agreement;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2f& ray = rays[static_cast<std::size_t>(v * camera.width + u)];
      const Eigen::Vector2f other = table.ray(u, v).head<2>();
      const bool has = !std::isnan(ray.x()), other_has = !std::isnan(other.x());
      agreement.both += has && other_has;
      agreement.neither += !has && !other_has;
      if (has && other_has) {
        agreement.worst =
            std::max(agreement.worst, camera.fx * static_cast<double>((ray - other).norm()));
      }
    }
  }
  return agreement;
}

constexpr std::size_t kPixels = 640 * 480;

TEST(CameraRays, PinholeIsTheCores) {
  const Agreement agreement = compare(distorted(DistortionModel::kNone, {}));
  EXPECT_EQ(agreement.both, kPixels);
  EXPECT_LT(agreement.worst, 1e-4);
}

TEST(CameraRays, DistortedLensesAreTheCores) {
  const Agreement plumb_bob =
      compare(distorted(DistortionModel::kPlumbBob, {0.08, -0.21, 1.5e-3, -2.1e-3, 0.09}));
  EXPECT_EQ(plumb_bob.both, kPixels);
  EXPECT_LT(plumb_bob.worst, 1e-3);
  const Agreement rational = compare(distorted(DistortionModel::kRationalPolynomial,
                                               {0.4, -0.1, 8e-4, -3e-4, 0.02, 0.35, -0.12, 0.03}));
  EXPECT_EQ(rational.both, kPixels);
  EXPECT_LT(rational.worst, 1e-3);
}

TEST(CameraRays, ALensThatFoldsHasNoRayAtTheRimForEither) {
  // x (1 - 0.9 r^2) turns back at r = 0.61: nothing is seen beyond 0.41 focal lengths.
  const Agreement agreement = compare(distorted(DistortionModel::kPlumbBob, {-0.9}));
  const double inside = 0.405 * 580.0;  // [px]
  EXPECT_GT(static_cast<double>(agreement.both), 0.95 * 3.14159 * inside * inside);
  EXPECT_GT(agreement.neither, kPixels / 3);
  EXPECT_GT(agreement.both + agreement.neither, kPixels * 98 / 100);
  // At the fold a small error in the image is a large one in the ray.
  EXPECT_LT(agreement.worst, 0.05);
}

}  // namespace
}  // namespace dominant_plane_detection
