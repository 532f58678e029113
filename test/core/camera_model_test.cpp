#include "dominant_plane_detection/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/ray_table.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

TEST(CameraModel, PaperCameraIsEquations2And3WithoutTheirTurn) {
  const CameraModel camera = paperCamera();
  const double f = 4.98, rho = 7.8e-3, x0 = 2.76, y0 = 2.26;  // [mm] Table I
  const double delta_x = 5.994e-3, delta_y = -7.027e-4;       // [mm]
  for (const double u : {0.0, 100.5, 639.0}) {
    for (const double v : {0.0, 300.25, 479.0}) {
      const Eigen::Vector2d ray = camera.ray({u, v});
      EXPECT_NEAR(ray.x(), (u * rho - x0 + delta_x) / f, 1e-12);  // -X/Z of Eq. 2
      EXPECT_NEAR(ray.y(), (v * rho - y0 + delta_y) / f, 1e-12);  // -Y/Z of Eq. 3
    }
  }
  EXPECT_NEAR(camera.fx, 638.46, 0.005);
  EXPECT_NEAR(camera.cx, 353.08, 0.005);
  EXPECT_NEAR(camera.cy, 289.83, 0.005);
}

TEST(CameraModel, PlumbBobAsInItsDefinition) {
  CameraModel camera = testCamera();
  camera.distortion = DistortionModel::kPlumbBob;
  camera.coefficients = {0.1, -0.2, 0.003, -0.004, 0.05};
  const double x = 0.3, y = -0.2, r2 = 0.13;
  const double radial = 1.0 + 0.1 * r2 - 0.2 * r2 * r2 + 0.05 * r2 * r2 * r2;
  const double xd = x * radial + 2.0 * 0.003 * x * y - 0.004 * (r2 + 2.0 * x * x);
  const double yd = y * radial + 0.003 * (r2 + 2.0 * y * y) - 2.0 * 0.004 * x * y;
  const Eigen::Vector2d pixel = camera.project({x, y});
  EXPECT_NEAR(pixel.x(), camera.fx * xd + camera.cx, 1e-9);
  EXPECT_NEAR(pixel.y(), camera.fy * yd + camera.cy, 1e-9);
}

class Distorted : public testing::TestWithParam<CameraModel> {};

TEST_P(Distorted, RayInvertsProjectOverTheWholeImage) {
  const CameraModel& camera = GetParam();
  for (int v = 0; v < camera.height; v += 7) {
    for (int u = 0; u < camera.width; u += 7) {
      const Eigen::Vector2d pixel = camera.project(camera.ray({u, v}));
      ASSERT_NEAR(pixel.x(), u, 1e-5);
      ASSERT_NEAR(pixel.y(), v, 1e-5);
    }
  }
}

TEST_P(Distorted, RayTableHoldsTheRays) {
  RayTable table;
  table.build(GetParam());
  for (const int v : {0, 100, 479}) {
    for (const int u : {0, 321, 639}) {
      const Eigen::Vector2d ray = GetParam().ray({u, v});
      EXPECT_NEAR(static_cast<double>(table.ray(u, v).x()), ray.x(), 1e-7);
      EXPECT_NEAR(static_cast<double>(table.ray(u, v).y()), ray.y(), 1e-7);
    }
  }
}

CameraModel withDistortion(DistortionModel model, const std::array<double, 8>& coefficients) {
  CameraModel camera = testCamera();
  camera.distortion = model;
  camera.coefficients = coefficients;
  return camera;
}

INSTANTIATE_TEST_SUITE_P(
    Models, Distorted,
    testing::Values(testCamera(),
                    withDistortion(DistortionModel::kPlumbBob, {0.05, -0.1, 1e-3, -2e-3, 0.02}),
                    withDistortion(DistortionModel::kPlumbBob, {-0.3, 0.12, 0.0, 0.0, -0.02}),
                    withDistortion(DistortionModel::kRationalPolynomial,
                                   {0.7, -0.4, 1e-4, 2e-4, -0.06, 1.0, -0.4, -0.1})));

TEST(CameraModel, NoRayWhereTheDistortionCannotBeInverted) {
  CameraModel camera = testCamera();
  camera.distortion = DistortionModel::kPlumbBob;
  camera.coefficients = {-2.0, 0.0, 0.0, 0.0, 0.0};  // turns over at r = 0.41
  EXPECT_TRUE(std::isnan(camera.ray({0.0, 0.0}).x()));
  EXPECT_NEAR(camera.ray({camera.cx, camera.cy}).x(), 0.0, 1e-12);
}

TEST(CameraModel, KnowsWhatCannotBeACamera) {
  EXPECT_FALSE(CameraModel().valid());
  EXPECT_TRUE(testCamera().valid());
  CameraModel camera = testCamera();
  camera.fy = -1.0;
  EXPECT_FALSE(camera.valid());
  camera = testCamera();
  camera.cx = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(camera.valid());
  camera = testCamera();
  camera.coefficients[3] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(camera.valid());
}

TEST(CameraModel, IsEqualInEveryNumberOrNotAtAll) {
  const CameraModel camera;
  EXPECT_EQ(camera.width + camera.height, 0);
  EXPECT_EQ(camera.fx + camera.fy + camera.cx + camera.cy, 0.0);
  EXPECT_TRUE(camera == CameraModel());
  const auto expectDifferent = [&](auto change) {
    CameraModel other = camera;
    change(other);
    EXPECT_TRUE(camera != other);
    EXPECT_FALSE(camera == other);
  };
  expectDifferent([](CameraModel& c) { c.width = 1; });
  expectDifferent([](CameraModel& c) { c.height = 1; });
  expectDifferent([](CameraModel& c) { c.fx = 1.0; });
  expectDifferent([](CameraModel& c) { c.fy = 1.0; });
  expectDifferent([](CameraModel& c) { c.cx = 1.0; });
  expectDifferent([](CameraModel& c) { c.cy = 1.0; });
  expectDifferent([](CameraModel& c) { c.distortion = DistortionModel::kPlumbBob; });
  expectDifferent([](CameraModel& c) { c.coefficients[7] = 1.0; });
}

}  // namespace
}  // namespace dominant_plane_detection
