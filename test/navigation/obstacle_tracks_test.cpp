#include "navigation/obstacle_tracks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "navigation/planar_pose.h"

namespace dominant_plane_detection {
namespace {

UprightBox boxAt(const Eigen::Vector2d& centre, double length = 0.2, double yaw = 0.0) {
  UprightBox box;
  box.centre = centre;
  box.length = length;
  box.width = 0.1;
  box.yaw = yaw;
  box.top = 0.3;
  return box;
}

/// A camera that turns and drives, fast: things are where they were.
TEST(ObstacleTracks, OdometryKeepsIdentities) {
  const std::vector<Eigen::Vector2d> things = {{2.0, 0.5}, {2.5, -0.4}, {3.0, 0.1}};
  ObstacleTracks tracks(1);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry2d camera = planarPose(0.1 * i, 0.02 * i, 0.15 * i);
    std::vector<UprightBox> boxes;
    for (std::size_t k = 0; k < things.size(); ++k) {
      boxes.push_back(boxAt(camera.inverse() * things[(k + i) % things.size()]));
    }
    const auto& tracked = tracks.follow(0.1 * i, boxes, camera);
    ASSERT_EQ(tracked.size(), things.size());
    for (std::size_t k = 0; k < things.size(); ++k) {
      EXPECT_EQ(tracked[k].id, (k + i) % things.size() + 1);
      EXPECT_EQ(tracked[k].images, static_cast<std::uint32_t>(i + 1));
      EXPECT_EQ(tracked[k].box.centre, boxes[k].centre);
    }
  }
}

TEST(ObstacleTracks, WithoutOdometryWhatMovesLittleIsTheSame) {
  ObstacleTracks tracks(1);
  const Eigen::Isometry2d none = Eigen::Isometry2d::Identity();
  EXPECT_EQ(tracks.follow(0.0, {boxAt({2.0, 0.0})}, none)[0].id, 1U);
  EXPECT_EQ(tracks.follow(0.1, {boxAt({1.9, 0.1})}, none)[0].id, 1U);
  EXPECT_EQ(tracks.follow(0.2, {boxAt({1.4, 0.1})}, none)[0].id, 2U);
}

/// Each box is the thing that it fits best, and one of them only.
TEST(ObstacleTracks, TheNearestIsTheSame) {
  ObstacleTracks tracks(1);
  const Eigen::Isometry2d none = Eigen::Isometry2d::Identity();
  tracks.follow(0.0, {boxAt({2.0, 0.0}), boxAt({2.0, 0.25})}, none);
  const auto& tracked =
      tracks.follow(0.1, {boxAt({2.0, 0.2}), boxAt({2.0, -0.05}), boxAt({2.0, 0.1})}, none);
  EXPECT_EQ(tracked[0].id, 2U);
  EXPECT_EQ(tracked[1].id, 1U);
  EXPECT_EQ(tracked[2].id, 3U);
}

/// Of a wall each image shows another part.
TEST(ObstacleTracks, AWallMayMoveAlongItself) {
  ObstacleTracks tracks(1);
  const Eigen::Isometry2d none = Eigen::Isometry2d::Identity();
  tracks.follow(0.0, {boxAt({3.0, 0.0}, 2.0, 0.5 * M_PI)}, none);
  EXPECT_EQ(tracks.follow(0.1, {boxAt({3.0, 0.6}, 1.2, 0.5 * M_PI)}, none)[0].id, 1U);
  EXPECT_EQ(tracks.follow(0.2, {boxAt({3.5, 0.6}, 1.2, 0.5 * M_PI)}, none)[0].id, 2U);
}

/// Also while the camera turns.
TEST(ObstacleTracks, AWallStaysAWallWhileTheCameraTurns) {
  ObstacleTracks tracks(1);
  const Eigen::Isometry2d turned = planarPose(0.0, 0.0, 1.2);
  tracks.follow(0.0, {boxAt({3.0, 0.0}, 2.0, 0.5 * M_PI)}, planarPose(0.0, 0.0, 0.0));
  const UprightBox part =
      boxAt(turned.inverse() * Eigen::Vector2d(3.0, 0.8), 1.0, 0.5 * M_PI - 1.2);
  EXPECT_EQ(tracks.follow(0.1, {part}, turned)[0].id, 1U);
  const UprightBox rest =
      boxAt(turned.inverse() * Eigen::Vector2d(3.0, 1.25), 0.8, 0.5 * M_PI - 1.2);
  EXPECT_EQ(tracks.follow(0.2, {rest}, turned)[0].id, 1U);
}

TEST(ObstacleTracks, WhatIsNotSeenForASecondIsForgotten) {
  ObstacleTracks tracks(1);
  const Eigen::Isometry2d none = Eigen::Isometry2d::Identity();
  tracks.follow(0.0, {boxAt({2.0, 0.0})}, none);
  tracks.follow(0.5, {}, none);
  EXPECT_EQ(tracks.follow(0.9, {boxAt({2.0, 0.0})}, none)[0].id, 1U);
  for (const double stamp : {1.5, 1.8, 2.0}) tracks.follow(stamp, {}, none);
  EXPECT_EQ(tracks.follow(2.1, {boxAt({2.0, 0.0})}, none)[0].id, 2U);
  // A recording that begins again has other things.
  EXPECT_EQ(tracks.follow(0.0, {boxAt({2.0, 0.0})}, none)[0].id, 3U);
  tracks.forget();
  EXPECT_EQ(tracks.follow(0.1, {boxAt({2.0, 0.0})}, none)[0].id, 4U);
}

/// Wrong readings are elsewhere in each image.
TEST(ObstacleTracks, AThingIsToldOnceItWasSeenOften) {
  ObstacleTracks tracks(3);
  const Eigen::Isometry2d none = Eigen::Isometry2d::Identity();
  const UprightBox thing = boxAt({2.0, 0.0});
  EXPECT_TRUE(tracks.follow(0.0, {thing}, none).empty());
  EXPECT_TRUE(tracks.follow(0.1, {boxAt({1.0, 0.5}), thing}, none).empty());
  const auto& tracked = tracks.follow(0.2, {boxAt({1.5, 1.0}), thing}, none);
  ASSERT_EQ(tracked.size(), 1U);
  EXPECT_EQ(tracked[0].id, 1U);
  EXPECT_EQ(tracked[0].images, 3U);
  EXPECT_EQ(tracked[0].box.centre, thing.centre);
  // What is seen in every third image only is not told any more.
  for (int i = 3; i < 30; ++i) {
    tracks.follow(0.1 * i, i % 3 == 0 ? std::vector<UprightBox>{thing} : std::vector<UprightBox>(),
                  none);
  }
  EXPECT_TRUE(tracks.follow(3.0, {thing}, none).empty());
}

/// While nobody listens things come and go.
TEST(ObstacleTracks, NothingIsKnownAfterALongSilence) {
  ObstacleTracks tracks(1);
  const Eigen::Isometry2d none = Eigen::Isometry2d::Identity();
  EXPECT_EQ(tracks.follow(0.0, {boxAt({2.0, 0.0})}, none)[0].id, 1U);
  EXPECT_EQ(tracks.follow(100.0, {boxAt({2.0, 0.0})}, none)[0].id, 2U);
}

/// Images may be a long time apart.
TEST(ObstacleTracks, SlowCamerasFollowThingsToo) {
  ObstacleTracks tracks(3);
  const Eigen::Isometry2d none = Eigen::Isometry2d::Identity();
  tracks.follow(0.0, {boxAt({2.0, 0.0})}, none);
  tracks.follow(2.0, {boxAt({2.0, 0.0})}, none);
  ASSERT_EQ(tracks.follow(4.0, {boxAt({2.0, 0.0})}, none).size(), 1U);
  tracks.follow(6.0, {}, none);
  ASSERT_EQ(tracks.follow(8.0, {boxAt({2.0, 0.0})}, none).size(), 1U);
}

}  // namespace
}  // namespace dominant_plane_detection
