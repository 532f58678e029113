#include "prior/plane_track.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

/// A camera 0.8 m over z = 0, somewhere, turned somehow.
Eigen::Isometry3d pose(double pitch, double x, double height) {
  Eigen::Isometry3d camera = Eigen::Isometry3d::Identity();
  camera.linear() = (Eigen::AngleAxisd(-M_PI / 2.0 - pitch, Eigen::Vector3d::UnitX()) *
                     Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitZ()))
                        .toRotationMatrix();
  camera.translation() = Eigen::Vector3d(x, 0.3, height);
  return camera;
}

/// What it sees of z = 0.
Detection groundFrom(const Eigen::Isometry3d& camera) {
  Detection detection;
  detection.state = State::kFound;
  detection.normal = camera.linear().transpose() * Eigen::Vector3d::UnitZ();
  detection.distance = camera.translation().z();
  return detection;
}

TEST(PlaneTrack, WithoutMotionThePlaneStays) {
  PlaneTrack track;
  EXPECT_FALSE(track.predict(1.0, {}));
  const Detection seen = groundFrom(pose(0.4, 0.0, 0.8));
  track.add(1.0, seen, std::nullopt);
  const auto predicted = track.predict(1.033, {});
  ASSERT_TRUE(predicted);
  EXPECT_LT((predicted->normal - seen.normal).norm(), 1e-12);
  EXPECT_EQ(predicted->distance, seen.distance);
  EXPECT_EQ(predicted->weight, 0.0);
  EXPECT_EQ(predicted->covariance(0, 0), -1.0);
}

TEST(PlaneTrack, ThePlaneMovesWithTheCamerasPose) {
  const Eigen::Isometry3d before = pose(0.4, 0.0, 0.8), now = pose(0.7, 0.2, 0.9);
  PlaneTrack track;
  Detection seen = groundFrom(before);
  // Sure of the height, not of the tilt.
  seen.covariance = Eigen::Matrix4d::Zero();
  const Eigen::Vector3d across = seen.normal.unitOrthogonal();
  seen.covariance.topLeftCorner<3, 3>() = 1e-4 * across * across.transpose();
  seen.covariance(3, 3) = 1e-6;
  track.add(1.0, seen, before);
  const auto predicted = track.predict(1.033, {now, std::nullopt});
  ASSERT_TRUE(predicted);
  const Detection truth = groundFrom(now);
  EXPECT_LT((predicted->normal - truth.normal).norm(), 1e-12);
  EXPECT_NEAR(predicted->distance, truth.distance, 1e-12);
  // By as much as the tilt makes of the way.
  const Eigen::Vector3d step =
      before.linear().transpose() * (now.translation() - before.translation());
  EXPECT_NEAR(predicted->covariance(3, 3), 1e-6 + 1e-4 * std::pow(across.dot(step), 2), 1e-12);
  const Eigen::Matrix3d of_normal = predicted->covariance.topLeftCorner<3, 3>();
  EXPECT_NEAR(of_normal.trace(), 1e-4, 1e-12);
}

TEST(PlaneTrack, AGyroscopeTurnsIt) {
  const Eigen::Isometry3d before = pose(0.4, 0.0, 0.8), now = pose(0.5, 0.0, 0.8);
  PlaneTrack track;
  track.add(1.0, groundFrom(before), std::nullopt);
  const Eigen::Quaterniond turn(before.linear().transpose() * now.linear());
  const auto predicted = track.predict(1.033, {std::nullopt, turn});
  ASSERT_TRUE(predicted);
  EXPECT_LT((predicted->normal - groundFrom(now).normal).norm(), 1e-12);
  EXPECT_NEAR(predicted->distance, 0.8, 1e-12);
}

TEST(PlaneTrack, IsDroppedByTimeAndByAnImageWithoutAPlane) {
  PlaneTrack track;
  const Detection seen = groundFrom(pose(0.4, 0.0, 0.8));
  track.add(10.0, seen, std::nullopt);
  EXPECT_EQ(track.stamp(), 10.0);
  EXPECT_TRUE(track.predict(10.5, {}));
  EXPECT_FALSE(track.predict(10.51, {}));
  EXPECT_FALSE(track.predict(9.99, {}));  // a bag that begins again
  track.add(10.1, Detection(), std::nullopt);
  EXPECT_FALSE(track.predict(10.13, {}));
  EXPECT_FALSE(track.stamp());
  track.add(10.2, seen, std::nullopt);
  track.reset();
  EXPECT_FALSE(track.predict(10.23, {}));
}

TEST(PlaneTrack, ItsWeightFallsWithTime) {
  PlaneTrack track(0.2);
  track.add(1.0, groundFrom(pose(0.4, 0.0, 0.8)), std::nullopt);
  EXPECT_NEAR(track.predict(1.2, {})->weight, std::exp(-1.0), 1e-9);
  EXPECT_NEAR(track.predict(1.1, {})->weight, std::exp(-0.5), 1e-9);
  EXPECT_EQ(track.predict(1.0, {})->weight, 0.0);  // the same image again
}

TEST(PlaneTrack, BehindThePlaneThereIsNone) {
  PlaneTrack track;
  track.add(1.0, groundFrom(pose(0.4, 0.0, 0.1)), pose(0.4, 0.0, 0.1));
  EXPECT_FALSE(track.predict(1.03, {pose(0.4, 0.0, -0.05), std::nullopt}));
}

}  // namespace
}  // namespace dominant_plane_detection
