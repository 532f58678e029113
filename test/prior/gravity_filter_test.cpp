#include "prior/gravity_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "prior/angle.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kGravity = 9.81;
const Eigen::Vector3d kUp = Eigen::Vector3d(0.2, -0.9, -0.3).normalized();

TEST(GravityFilter, AtRestUpIsWhatIsFelt) {
  GravityFilter filter;
  EXPECT_FALSE(filter.up(0.0));
  filter.add({0.0, kGravity * kUp, std::nullopt});
  EXPECT_FALSE(filter.up(0.0));  // one reading may be a blow
  for (int i = 1; i < 10; ++i) filter.add({0.03 * i, 1.03 * kGravity * kUp, std::nullopt});
  const auto up = filter.up(0.27);
  ASSERT_TRUE(up);
  EXPECT_LT(angleBetween(up->direction, kUp), 1e-9);
  EXPECT_NEAR(up->direction.norm(), 1.0, 1e-12);
  EXPECT_NEAR(up->error, 2.0 * kDegree, 1e-3);
}

TEST(GravityFilter, ReadingsThatAreNotOfTheImagesTimeDoNotCount) {
  GravityFilter filter;
  for (int i = 0; i <= 10; ++i) filter.add({1.0 + 0.03 * i, kGravity * kUp, std::nullopt});
  EXPECT_TRUE(filter.up(1.3 + 0.19));
  EXPECT_FALSE(filter.up(1.3 + 0.21));
  EXPECT_TRUE(filter.up(1.3 - 0.19));
  EXPECT_FALSE(filter.up(1.3 - 0.21));
  filter.add({0.5, kGravity * kUp, std::nullopt});  // a bag that begins again
  EXPECT_FALSE(filter.up(0.5));
  for (int i = 0; i <= 10; ++i) filter.add({1.0 + 0.03 * i, kGravity * kUp, std::nullopt});
  filter.add({2.5, kGravity * kUp, std::nullopt});  // a gap
  EXPECT_FALSE(filter.up(2.5));
  filter.reset();
  EXPECT_FALSE(filter.up(2.5));
}

/// A hand that shakes by half of gravity at 2 Hz.
TEST(GravityFilter, ShakingIsAveragedAndItsSizeTold) {
  GravityFilter filter;
  const Eigen::Vector3d shaking = 0.3 * kGravity * kUp.unitOrthogonal();
  double worst = 0.0, worst_raw = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double stamp = i / 30.0;
    const Eigen::Vector3d felt = kGravity * kUp + std::sin(4.0 * M_PI * stamp) * shaking;
    filter.add({stamp, felt, std::nullopt});
    if (i < 60) continue;
    const auto up = filter.up(stamp);
    ASSERT_TRUE(up);
    worst = std::max(worst, angleBetween(up->direction, kUp));
    worst_raw = std::max(worst_raw, angleBetween(felt, kUp));
    EXPECT_LT(angleBetween(up->direction, kUp), up->error);
    EXPECT_NEAR(up->error, std::atan(0.3) / std::sqrt(2.0), 5.0 * kDegree);
  }
  EXPECT_LT(worst, 0.35 * worst_raw);
}

/// A blow of three times gravity from the side hardly counts.
TEST(GravityFilter, WhatIsNotOfGravitysSizeCountsLess) {
  GravityFilter filter;
  for (int i = 0; i < 30; ++i) filter.add({i / 30.0, kGravity * kUp, std::nullopt});
  const Eigen::Vector3d blow = 3.0 * kGravity * kUp.unitOrthogonal();
  for (int i = 30; i < 33; ++i) filter.add({i / 30.0, kGravity * kUp + blow, std::nullopt});
  EXPECT_LT(angleBetween(filter.up(32 / 30.0)->direction, kUp), 2.0 * kDegree);
}

/// At 90 degrees a second about an axis across gravity, the mean lags far behind; with a gyroscope
/// it does not.
TEST(GravityFilter, TurningIsFollowedByAGyroscopeAndToldWithoutOne) {
  for (const bool has_gyroscope : {false, true}) {
    GravityFilter filter;
    const Eigen::Vector3d axis = kUp.unitOrthogonal();
    Up up{};
    Eigen::Vector3d truth;
    for (int i = 0; i <= 60; ++i) {
      const double stamp = i / 60.0;
      const double turned = 90.0 * kDegree * stamp;
      truth = Eigen::AngleAxisd(-turned, axis) * kUp;  // in the sensor's frame
      const auto rate =
          has_gyroscope ? std::make_optional<Eigen::Vector3d>(90.0 * kDegree * axis) : std::nullopt;
      filter.add({stamp, kGravity * truth, rate});
    }
    up = *filter.up(1.0);
    const double error = angleBetween(up.direction, truth);
    if (has_gyroscope) {
      EXPECT_LT(error, 0.1 * kDegree);
      EXPECT_LT(up.error, 2.1 * kDegree);
    } else {
      EXPECT_GT(error, 10.0 * kDegree);
      EXPECT_GT(up.error, 0.7 * error);
    }
  }
}

TEST(GravityFilter, WhatIsNoReadingIsLeftOut) {
  GravityFilter filter;
  for (int i = 0; i < 10; ++i) {
    filter.add({0.03 * i, kGravity * kUp, std::nullopt});
    filter.add({0.03 * i, Eigen::Vector3d::Zero(), std::nullopt});
    filter.add({0.03 * i, Eigen::Vector3d::Constant(NAN), std::nullopt});
  }
  EXPECT_LT(angleBetween(filter.up(0.27)->direction, kUp), 1e-9);
}

}  // namespace
}  // namespace dominant_plane_detection
