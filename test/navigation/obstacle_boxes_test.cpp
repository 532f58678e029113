#include "navigation/obstacle_boxes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "navigation/ground_sight.h"

namespace dominant_plane_detection {
namespace {

class Boxes : public ::testing::Test {
 protected:
  const std::vector<UprightBox>& find(const ObstacleLimits& limits = {}) {
    return finder_.find(sight_.depth(), sight_.rays(), sight_.detection(), limits, local_error_);
  }
  NoiseModel local_error_{0.0005, 0.0012};
  GroundSight sight_{25.0 * kDegree, 6.0 * kDegree};

 private:
  ObstacleBoxes finder_;
};

TEST_F(Boxes, ABoxHasItsPlaceAndItsSize) {
  sight_.addBox({1.5, -0.1, 0.0}, {1.7, 0.3, 0.25});
  const auto& boxes = find();
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_LT((boxes[0].centre - Eigen::Vector2d(1.6, 0.1)).norm(), 0.015);
  EXPECT_NEAR(boxes[0].length, 0.4, 0.02);
  EXPECT_NEAR(boxes[0].width, 0.2, 0.02);
  EXPECT_NEAR(std::abs(std::sin(boxes[0].yaw)), 1.0, 1e-6);  // its length is across the view
  EXPECT_EQ(boxes[0].bottom, 0.0);
  EXPECT_NEAR(boxes[0].top, 0.25, 0.01);
  EXPECT_NEAR(boxes[0].distance, 1.5, 0.01);
  const auto& labels = sight_.detection().labels;
  const auto pixels = static_cast<double>(
      std::count(labels.begin(), labels.end(), static_cast<std::uint8_t>(Label::kObstacle)));
  EXPECT_NEAR(static_cast<double>(boxes[0].pixels), pixels, 0.05 * pixels);
}

/// Its top is seen at six degrees: three rows of pixels, far apart on the ground.
TEST_F(Boxes, ATopThatIsSeenAtALowAngleBelongsToIt) {
  sight_.addBox({2.0, -0.15, 0.0}, {2.3, 0.15, 0.38});
  const auto& boxes = find();
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_LT((boxes[0].centre - Eigen::Vector2d(2.15, 0.0)).norm(), 0.03);
  EXPECT_NEAR(boxes[0].length, 0.3, 0.04);
  EXPECT_NEAR(boxes[0].width, 0.3, 0.04);
}

TEST_F(Boxes, ThingsApartAreTwoAndTheNearerIsFirst) {
  sight_.addBox({2.0, -0.5, 0.0}, {2.2, -0.3, 0.2});
  sight_.addBox({1.4, 0.2, 0.0}, {1.6, 0.4, 0.2});
  sight_.addBox({2.4, 0.2, 0.0}, {2.6, 0.4, 0.5});  // behind the second, and over it
  const auto& boxes = find();
  ASSERT_EQ(boxes.size(), 3U);
  EXPECT_LT((boxes[0].centre - Eigen::Vector2d(1.5, 0.3)).norm(), 0.02);
  EXPECT_LT((boxes[1].centre - Eigen::Vector2d(2.1, -0.4)).norm(), 0.02);
  EXPECT_NEAR(boxes[2].distance, std::hypot(2.4, 0.2), 0.03);
}

TEST_F(Boxes, ThingsThatTouchAreOne) {
  sight_.addBox({1.5, -0.2, 0.0}, {1.7, 0.0, 0.2});
  sight_.addBox({1.5, 0.0, 0.0}, {1.7, 0.2, 0.3});
  const auto& boxes = find();
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_NEAR(boxes[0].length, 0.4, 0.02);
}

TEST_F(Boxes, AColumnWithoutReadingsDoesNotDivideIt) {
  sight_.addBox({1.5, -0.2, 0.0}, {1.7, 0.2, 0.25});
  for (int v = 0; v < 480; ++v) {
    for (const int u : {318, 319}) {
      sight_.detection().labels[sight_.detection().indexOf(u, v)] =
          static_cast<std::uint8_t>(Label::kUnknown);
    }
  }
  EXPECT_EQ(find().size(), 1U);
}

TEST_F(Boxes, WhatHangsHasABottom) {
  sight_.addBox({1.5, -0.2, 0.35}, {1.7, 0.2, 0.45});
  const auto& boxes = find();
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_NEAR(boxes[0].bottom, 0.35, 0.01);
  EXPECT_NEAR(boxes[0].top, 0.45, 0.01);
}

TEST_F(Boxes, OnlyWhatTheRobotWouldTouch) {
  sight_.addBox({1.5, -0.5, 0.0}, {1.7, -0.3, 0.08});
  sight_.addBox({1.5, 0.3, 0.4}, {1.7, 0.5, 0.5});
  EXPECT_EQ(find().size(), 2U);
  ObstacleLimits robot;
  robot.clearance_height = 0.1;
  EXPECT_EQ(find(robot).size(), 1U);
  robot.max_obstacle_height = 0.3;
  EXPECT_TRUE(find(robot).empty());
}

/// A floor that the camera's error bends up far away is no thing: it has no face.
TEST_F(Boxes, ABentFloorIsNone) {
  sight_.changeFloor([](const Eigen::Vector2d& at, float& depth, std::uint8_t& label) {
    // Rises by 12 % from 1.6 m on.
    if (at.x() < 1.6 || at.x() > 3.0) return;
    const double nearer = (1.0 + 0.12 * 1.6 / kSightHeight) / (1.0 + 0.12 * at.x() / kSightHeight) *
                          static_cast<double>(depth);
    depth = static_cast<float>(nearer);
    if (at.x() > 2.0) label = static_cast<std::uint8_t>(Label::kObstacle);
  });
  EXPECT_TRUE(find().empty());
}

TEST_F(Boxes, WhatIsLowerThanTheErrorOfTheGroundIsNone) {
  sight_.addBox({1.5, -0.2, 0.0}, {1.7, 0.2, 0.04});
  EXPECT_EQ(find().size(), 1U);
  local_error_.quadratic = 0.005;  // 4.8 times it, 1.6 m away: 6 cm
  EXPECT_TRUE(find().empty());
  sight_.addBox({1.5, -0.2, 0.2}, {1.7, 0.2, 0.22});  // no ground is so high
  EXPECT_EQ(find().size(), 1U);
}

TEST_F(Boxes, WithoutAPlaneThereAreNone) {
  sight_.addBox({1.5, -0.2, 0.0}, {1.7, 0.2, 0.25});
  EXPECT_EQ(find().size(), 1U);
  sight_.detection() = Detection();
  EXPECT_TRUE(find().empty());
}

/// Two walls in a corner: no box has the room between them in it.
TEST_F(Boxes, ACornerIsMoreThanOne) {
  sight_.addBox({2.6, -1.2, 0.0}, {2.7, 0.8, 1.0});
  sight_.addBox({1.0, 0.7, 0.0}, {2.7, 0.8, 1.0});
  const auto& boxes = find();
  ASSERT_GE(boxes.size(), 2U);
  for (const UprightBox& box : boxes) {
    const Eigen::Vector2d inside =
        Eigen::Rotation2Dd(-box.yaw) * (Eigen::Vector2d(1.6, -0.2) - box.centre);
    EXPECT_TRUE(std::abs(inside.x()) > 0.5 * box.length || std::abs(inside.y()) > 0.5 * box.width);
    EXPECT_TRUE(box.length <= 1.2 || box.width <= 0.4);
  }
}

TEST_F(Boxes, ASpeckIsNone) {
  sight_.addBox({1.5, -0.01, 0.0}, {1.52, 0.01, 0.06});
  EXPECT_TRUE(find().empty());
}

}  // namespace
}  // namespace dominant_plane_detection
