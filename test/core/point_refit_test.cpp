#include "core/point_refit.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace dominant_plane_detection {
namespace {

/// Points of a rough plane about (0, 0, 2), anywhere.
PlaneMoments roughRegion(unsigned seed, int size) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> gauss;
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond(gauss(generator), gauss(generator), gauss(generator), gauss(generator))
          .normalized()
          .toRotationMatrix();
  PlaneMoments moments;
  for (int i = 0; i < size; ++i) {
    const Eigen::Vector3d local(0.3 * gauss(generator), 0.2 * gauss(generator),
                                0.005 * gauss(generator));
    moments.add(turn * local + Eigen::Vector3d(0.0, 0.0, 2.0));
  }
  return moments;
}

TEST(PointRefit, IsTheFitWithThePoint) {
  std::mt19937 generator(1);
  std::normal_distribution<double> gauss;
  int compared = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const PlaneMoments region = roughRegion(seed, 3 + static_cast<int>(seed) % 40);
    PointRefit refit;
    refit.setRegion(region);
    const Eigen::Vector3d point(0.5 * gauss(generator), 0.5 * gauss(generator),
                                2.0 + 0.5 * gauss(generator));
    PlaneMoments with_point = region;
    with_point.add(point);
    const auto expected = with_point.fit();
    const auto fit = refit.with(point);
    ASSERT_TRUE(expected && fit) << seed;
    const double sum_squares = expected->mean_square_error * with_point.count();
    EXPECT_NEAR(fit->sum_squares, sum_squares, 1e-9 * sum_squares + 1e-12) << seed;
    EXPECT_NEAR(fit->distance, std::abs(expected->plane.signedDistance(point)), 1e-8) << seed;
    ++compared;
  }
  EXPECT_EQ(compared, 200);
}

TEST(PointRefit, TellsTheRegionsPlaneAndItsRounding) {
  const PlaneMoments region = roughRegion(7, 50);
  PointRefit refit;
  refit.setRegion(region);
  EXPECT_NEAR(std::abs(refit.normal().dot(region.fit()->plane.normal)), 1.0, 1e-12);
  const Eigen::Vector3d values = refit.eigenvalues();
  EXPECT_TRUE(values[0] < values[1] && values[1] < values[2]);
  EXPECT_NEAR(values.sum(), region.scatter().trace(), 1e-9);
  const double moments = values[2] + region.count() * region.centre().squaredNorm();
  EXPECT_NEAR(refit.rounding(), 1e-14 * moments, 1e-18);
}

TEST(PointRefit, APointOnThePlaneIsLeftToOthers) {
  PlaneMoments flat;
  for (int i = 0; i < 9; ++i) flat.add({0.1 * (i % 3), 0.1 * (i / 3), 1.0});
  PointRefit refit;
  refit.setRegion(flat);
  EXPECT_FALSE(refit.with({0.5, 0.7, 1.0}));
  EXPECT_TRUE(refit.with({0.5, 0.7, 1.01}));
}

/// Points nearly in a line: between the direction of the normal and the one next to it there is a
/// gap of a million roundings, or less.
TEST(PointRefit, ANormalThatIsNearlyOpenIsLeftToOthers) {
  for (const double share : {1e-3, 0.4, 0.6, 0.8, 1.25, 1.7, 2.5}) {
    const auto strip = [](double width) {
      PlaneMoments moments;
      for (int i = 0; i < 20; ++i) moments.add({0.05 * i, i % 2 == 0 ? width : -width, 1.0});
      return moments;
    };
    PointRefit refit;
    refit.setRegion(strip(1e-3));
    // The gap is the scatter across the strip; the point hardly changes it.
    const double rounding = refit.rounding();
    const double width = std::sqrt(share * 1e6 * rounding / 20.0);
    refit.setRegion(strip(width));
    EXPECT_NEAR(refit.eigenvalues()[1] - refit.eigenvalues()[0], share * 1e6 * rounding,
                0.1 * share * 1e6 * rounding);
    EXPECT_EQ(refit.with({0.5, 0.0, 1.0 + 1e-3 * width}).has_value(), share > 1.0) << share;
  }
}

}  // namespace
}  // namespace dominant_plane_detection
