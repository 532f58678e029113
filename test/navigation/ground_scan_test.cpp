#include "navigation/ground_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "navigation/ground_frame.h"
#include "navigation/ground_sight.h"

namespace dominant_plane_detection {
namespace {

constexpr double kHeight = kSightHeight;

class Sight : public GroundSight {
 public:
  using GroundSight::GroundSight;
  const GroundScan& scan(const ScanLimits& limits = {}) {
    return scanner_.scan(depth(), rays(), detection(), limits);
  }
  /// @return [m] the reading in a direction.
  double at(double direction, const ScanLimits& limits = {}) {
    const GroundScan& s = scan(limits);
    const double index = (direction - s.angle_min) / s.angle_increment;
    return static_cast<double>(s.ranges.at(static_cast<std::size_t>(std::lround(index))));
  }

 private:
  GroundScanner scanner_;
};

TEST(GroundFrame, IsBelowTheCameraAndLooksAhead) {
  for (const double roll : {-0.4, 0.0, 0.3}) {
    const Eigen::Vector3d up = upOf(0.5, roll);
    const Eigen::Isometry3d frame = groundFromOptical(up, kHeight);
    EXPECT_LT((frame.linear() * frame.linear().transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-12);
    EXPECT_NEAR(frame.linear().determinant(), 1.0, 1e-12);
    EXPECT_LT((frame * Eigen::Vector3d::Zero() - Eigen::Vector3d(0, 0, kHeight)).norm(), 1e-12);
    // Where the optical axis meets the plane is ahead of it.
    const Eigen::Vector3d met = frame * Eigen::Vector3d(0, 0, kHeight / std::sin(0.5));
    EXPECT_NEAR(met.x(), kHeight / std::tan(0.5), 1e-9);
    EXPECT_NEAR(met.y(), 0.0, 1e-9);
    EXPECT_NEAR(met.z(), 0.0, 1e-9);
    // What is right in the image is right of it.
    EXPECT_LT((frame.linear() * Eigen::Vector3d(1, 0, 0)).y(), -0.8);
  }
  const Eigen::Isometry3d down = groundFromOptical({0.0, 0.0, -1.0}, 2.0);
  EXPECT_LT((down.linear() * Eigen::Vector3d(0, -1, 0) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((down.linear() * Eigen::Vector3d(1, 0, 0) + Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

/// Whatever the camera's pitch and roll, a post is where it is.
TEST(GroundScanner, APostIsInItsDirectionAtItsRange) {
  for (const double pitch : {0.0, 20.0, 35.0}) {
    for (const double roll : {-10.0, 0.0, 10.0}) {
      for (const double direction : {-15.0, 0.0, 8.5, 20.0}) {
        Sight sight(pitch * kDegree, roll * kDegree);
        sight.addPost(direction * kDegree, 1.8, 0.0, 0.5);
        for (const double off : {-1.0, 0.0, 1.0}) {
          EXPECT_NEAR(sight.at((direction + off) * kDegree), 1.8, 0.002)
              << pitch << " " << roll << " " << direction;
        }
        EXPECT_FALSE(std::isfinite(sight.at((direction + 2.5) * kDegree)));
        EXPECT_FALSE(std::isfinite(sight.at((direction - 2.5) * kDegree)));
      }
    }
  }
}

TEST(GroundScanner, ReadingsFollowRep117) {
  Sight sight(0.35, 0.1);
  const double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sight.at(0.0), kInfinity);  // seen to be free
  const GroundScan& scan = sight.scan();
  EXPECT_GT(scan.range_max, 3.0);
  EXPECT_LT(scan.range_max, 4.5);
  EXPECT_GT(scan.range_min, 0.0);
  EXPECT_NEAR(scan.angle_increment, 0.5 * kDegree, 1e-9);
  EXPECT_NEAR(scan.angle(scan.ranges.size() - 1), -scan.angle_min, 1e-9);
  EXPECT_NEAR(-scan.angle_min, 35.0 * kDegree, 5.0 * kDegree);  // the lower corners see more
  for (const float range : scan.ranges) {
    const bool reading = static_cast<double>(range) >= scan.range_min &&
                         static_cast<double>(range) <= scan.range_max;
    EXPECT_TRUE(reading || std::isnan(range) || range == INFINITY);
  }
  sight.mark(0.0, 1.5, Label::kUnknown);  // not seen any more from there on
  EXPECT_TRUE(std::isnan(sight.at(0.0)));
  EXPECT_EQ(sight.at(0.1), kInfinity);
}

/// A black object or a hole: the floor behind it does not make the direction free.
TEST(GroundScanner, WhatIsNotSeenOnTheWayIsNotFree) {
  for (const Label label : {Label::kUnknown, Label::kMissingGround}) {
    Sight sight(0.35, 0.0);
    sight.mark(0.0, 1.4, label);
    sight.mark(0.0, 1.7, Label::kGround);
    EXPECT_TRUE(std::isnan(sight.at(0.0)));
    EXPECT_EQ(sight.at(0.15), std::numeric_limits<double>::infinity());
    // Nor does something that is beyond the range.
    sight.addPost(0.0, 4.5, 0.0, 1.0);
    EXPECT_TRUE(std::isnan(sight.at(0.0)));
  }
}

TEST(GroundScanner, OnlyWhatTheRobotTouchesCounts) {
  Sight sight(0.3, 0.0);
  sight.addPost(0.0, 1.6, 0.0, 0.05);
  sight.addPost(0.2, 1.6, 0.45, 0.8);
  ScanLimits robot;
  EXPECT_NEAR(sight.at(0.0, robot), 1.6, 0.002);
  EXPECT_NEAR(sight.at(0.2, robot), 1.6, 0.002);
  robot.clearance_height = 0.06;
  robot.max_obstacle_height = 0.44;
  EXPECT_FALSE(std::isfinite(sight.at(0.0, robot)));
  EXPECT_FALSE(std::isfinite(sight.at(0.2, robot)));
}

TEST(GroundScanner, ADropOffIsAtItsEdge) {
  Sight sight(0.4, 0.05);
  sight.mark(0.0, 1.3, Label::kDropOff);
  EXPECT_NEAR(sight.at(0.0), 1.3, 0.03);
  sight.mark(0.2, 1.3, Label::kMissingGround);
  EXPECT_FALSE(std::isfinite(sight.at(0.2)));
  ScanLimits careful;
  careful.missing_ground = true;
  EXPECT_NEAR(sight.at(0.2, careful), 1.3, 0.03);
}

TEST(GroundScanner, TheNearestOfSeveralWinsAndSinglePixelsAreNone) {
  Sight sight(0.3, 0.0);
  sight.addPost(0.0, 2.4, 0.0, 0.6);
  EXPECT_NEAR(sight.at(0.0), 2.4, 0.002);
  // Three pixels of one direction, nearer.
  Detection& detection = sight.detection();
  for (int v = 300; v < 303; ++v) {
    detection.labels[detection.indexOf(320, v)] = static_cast<std::uint8_t>(Label::kObstacle);
  }
  EXPECT_NEAR(sight.at(0.0), 2.4, 0.002);
  sight.addPost(0.0, 1.9, 0.0, 0.3);
  EXPECT_NEAR(sight.at(0.0), 1.9, 0.002);
}

/// A camera that looks down sees all about its foot.
TEST(GroundScanner, LookingDownAllDirectionsAreSeen) {
  Sight sight(M_PI / 2.0, 0.0);
  const GroundScan& scan = sight.scan();
  EXPECT_NEAR(scan.angle_min, -M_PI, 1.0 * kDegree);
  EXPECT_GE(scan.ranges.size(), 715U);
  EXPECT_NEAR(scan.range_max, kHeight * 239.5 / 525.0, 0.01);
}

TEST(GroundScanner, WithoutAPlaneThereAreNoReadings) {
  Sight sight(0.3, 0.0);
  sight.detection().state = State::kNoRegion;
  EXPECT_TRUE(sight.scan().ranges.empty());
}

TEST(GroundScanner, SmallImagesNeedFewerPixels) {
  Sight sight(0.3, 0.0, testCamera(160, 120));
  sight.addPost(0.0, 1.8, 0.0, 0.3);
  EXPECT_NEAR(sight.at(0.0), 1.8, 0.002);
}

}  // namespace
}  // namespace dominant_plane_detection
