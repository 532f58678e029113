#include "navigation/obstacle_boxes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "navigation/ground_sight.h"

namespace dominant_plane_detection {
namespace {

/// Lets the floor rise by 12 % from 1.6 m on, as errors do.
void bendFloor(GroundSight& sight) {
  sight.changeFloor([](const Eigen::Vector2d& at, float& depth, std::uint8_t& label) {
    // Rises by 12 % from 1.6 m on.
    if (at.x() < 1.6 || at.x() > 3.0) return;
    const double nearer = (1.0 + 0.12 * 1.6 / kSightHeight) / (1.0 + 0.12 * at.x() / kSightHeight) *
                          static_cast<double>(depth);
    depth = static_cast<float>(nearer);
    if (at.x() > 2.0) label = static_cast<std::uint8_t>(Label::kObstacle);
  });
}

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

/// Its top is seen at three degrees: a few rows of pixels, far apart on the ground.
TEST_F(Boxes, ATopThatIsSeenAtALowAngleBelongsToIt) {
  sight_.addBox({2.0, -0.15, 0.0}, {2.5, 0.15, 0.5});
  const auto& boxes = find();
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_NEAR(boxes[0].length, 0.5, 0.15);
  EXPECT_NEAR(boxes[0].width, 0.3, 0.04);
}

/// One reading in four hundred is 7 cm off.
TEST_F(Boxes, SingleWrongReadingsDoNotMakeItLarger) {
  sight_.addBox({1.5, -0.2, 0.0}, {1.52, 0.2, 0.25});
  int number = 0;
  sight_.changeFloor([&](const Eigen::Vector2d&, float& depth, std::uint8_t& label) {
    if (label != static_cast<std::uint8_t>(Label::kObstacle)) return;
    if (++number % 400 == 0) depth += 0.07F;
  });
  const auto& boxes = find();
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_LT(boxes[0].width, 0.05);
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

/// However the camera is rolled: on its side and on its head, too.
TEST(BoxesOfARolledCamera, AreTheSame) {
  for (const double roll : {0.0, 60.0, 90.0, 180.0, -90.0, -135.0}) {
    GroundSight sight(25.0 * kDegree, roll * kDegree);
    sight.addBox({1.5, -0.1, 0.0}, {1.7, 0.2, 0.25});
    ObstacleBoxes finder;
    const auto& boxes =
        finder.find(sight.depth(), sight.rays(), sight.detection(), {}, {0.0005, 0.0012});
    ASSERT_EQ(boxes.size(), 1U) << roll;
    EXPECT_LT((boxes[0].centre - Eigen::Vector2d(1.6, 0.05)).norm(), 0.02) << roll;
    EXPECT_NEAR(boxes[0].length, 0.3, 0.03) << roll;
    // And the floor is none, when it bends.
    GroundSight bent(25.0 * kDegree, roll * kDegree);
    bendFloor(bent);
    EXPECT_TRUE(
        finder.find(bent.depth(), bent.rays(), bent.detection(), {}, {0.0005, 0.0012}).empty())
        << roll;
  }
}

/// From above, things have no sides.
TEST(BoxesOfARolledCamera, ThatLooksDownAreToldByTheirHeight) {
  GroundSight sight(85.0 * kDegree, 0.0);
  sight.addBox({-0.05, -0.1, 0.0}, {0.15, 0.1, 0.1});
  ObstacleBoxes finder;
  const auto& boxes =
      finder.find(sight.depth(), sight.rays(), sight.detection(), {}, {0.0005, 0.0012});
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_NEAR(boxes[0].length, 0.2, 0.02);
}

/// What has no reading below it is no face, whatever stands for "no reading".
TEST_F(Boxes, InfinityIsNoReading) {
  sight_.changeFloor([](const Eigen::Vector2d& at, float& depth, std::uint8_t& label) {
    // A floor that bends, every other row of pixels of which is missing.
    if (at.x() < 2.0 || at.x() > 3.0) return;
    depth *= 0.9F;
    label = static_cast<std::uint8_t>(Label::kObstacle);
    if (static_cast<int>(at.x() * 40.0) % 2 == 0) {
      depth = INFINITY;
      label = static_cast<std::uint8_t>(Label::kUnknown);
    }
  });
  EXPECT_TRUE(find().empty());
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
  ASSERT_EQ(find(robot).size(), 1U);
  robot.max_obstacle_height = 0.3;
  EXPECT_TRUE(find(robot).empty());
}

/// A floor that the camera's error bends up far away is no thing: it has no face.
/// What is cut off by the robot's clearance stands on the ground all the same.
TEST_F(Boxes, WhatTheRobotPassesOverIsNoBottom) {
  sight_.addBox({1.5, -0.2, 0.0}, {1.7, 0.2, 0.25});
  ObstacleLimits robot;
  robot.clearance_height = 0.15;
  ASSERT_EQ(find(robot).size(), 1U);
  EXPECT_EQ(find(robot)[0].bottom, 0.0);
}

TEST_F(Boxes, ABentFloorIsNone) {
  bendFloor(sight_);
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
