#include "prior/known_up.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = M_PI / 180.0;

/// @param degrees away from upright.
Up up(double degrees, double error = 0.0) {
  return {{std::sin(degrees * kDegree), -std::cos(degrees * kDegree), 0.0}, error};
}

TEST(UpChoice, TfComesBeforeGravityAndGravityBeforeNothing) {
  UpChoice choice;
  const auto both = choice.choose(1.0, {up(0.0), up(5.0), "", ""});
  ASSERT_TRUE(both);
  EXPECT_EQ(both->source, UpSource::kTf);
  EXPECT_EQ(both->up.direction, up(0.0).direction);
  EXPECT_EQ(choice.remark(), "");
  const auto gravity = choice.choose(1.0, {std::nullopt, up(5.0), "", ""});
  ASSERT_TRUE(gravity);
  EXPECT_EQ(gravity->source, UpSource::kImu);
  EXPECT_EQ(gravity->up.direction, up(5.0).direction);
  EXPECT_FALSE(choice.choose(1.0, {}));
  EXPECT_EQ(choice.remark(), "");
}

TEST(UpChoice, WhatIsMissingIsSaid) {
  UpChoice choice;
  choice.choose(1.0, {std::nullopt, up(5.0), "No tf.", ""});
  EXPECT_EQ(choice.remark(), "No tf.");
  choice.choose(1.0, {std::nullopt, std::nullopt, "No tf.", "No imu."});
  EXPECT_EQ(choice.remark(), "No tf. No imu.");
  // Gravity is not missed where tf is there.
  choice.choose(1.0, {up(0.0), std::nullopt, "", "No imu."});
  EXPECT_EQ(choice.remark(), "");
}

TEST(UpChoice, TfThatContradictsGravityForASecondIsPassedOver) {
  UpChoice choice;
  const auto source = [&](double stamp, double angle, double error) {
    return choice.choose(stamp, {up(0.0), up(angle, error), "", ""})->source;
  };
  EXPECT_EQ(source(1.0, 30.0, 0.0), UpSource::kTf);
  EXPECT_EQ(source(1.9, 30.0, 0.0), UpSource::kTf);
  EXPECT_EQ(choice.remark(), "");
  EXPECT_EQ(source(2.0, 30.0, 0.0), UpSource::kImu);
  EXPECT_EQ(choice.remark(),
            "Up by tf is 30 deg from up by gravity (at most 15): gravity is taken.");
  // Within a ramp and an error of gravity it is none.
  EXPECT_EQ(source(2.1, 14.0, 0.0), UpSource::kTf);
  EXPECT_EQ(source(2.2, 16.0, 0.0), UpSource::kTf);  // has only begun
  EXPECT_EQ(source(3.3, 16.0, 2.0 * kDegree), UpSource::kTf);
  EXPECT_EQ(source(3.4, 16.0, 0.0), UpSource::kTf);
  EXPECT_EQ(source(4.4, 16.0, 0.0), UpSource::kImu);
  // What is missing for a moment contradicts nothing.
  EXPECT_EQ(choice.choose(4.5, {up(0.0), std::nullopt, "", ""})->source, UpSource::kTf);
  EXPECT_EQ(source(4.6, 16.0, 0.0), UpSource::kTf);
  EXPECT_EQ(source(5.6, 16.0, 0.0), UpSource::kImu);
  // Time that goes back begins anew.
  EXPECT_EQ(source(1.0, 16.0, 0.0), UpSource::kTf);
}

}  // namespace
}  // namespace dominant_plane_detection
