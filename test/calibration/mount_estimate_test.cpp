#include "calibration/mount_estimate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <stdexcept>

#include "synthetic/camera_path.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDepth = "camera_depth_optical_frame";

/// What a perfect detector says of free floor.
Detection seenFrom(const KeyPose& key, double share = 0.8) {
  const Eigen::Isometry3d pose = key.pose();
  Detection detection;
  detection.state = State::kFound;
  detection.normal = pose.linear().transpose() * Eigen::Vector3d::UnitZ();
  detection.distance = pose.translation().z();
  detection.valid_pixels = 1000;
  detection.inliers = static_cast<std::size_t>(1000 * share);
  return detection;
}

KeyPose key(double height, double pitch, double roll) {
  KeyPose pose;
  pose.position.z() = height;
  pose.pitch = pitch;
  pose.roll = roll;
  pose.yaw = 0.7;  // does not matter
  return pose;
}

std::string problemOf(const MountEstimate& estimate) {
  try {
    estimate.mount();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "none";
}

TEST(MountEstimateTest, GivesThePoseOverTheFloor) {
  for (const double pitch : {-0.2, 0.0, 0.4, 1.2}) {
    for (const double roll : {-0.3, 0.0, 0.2}) {
      MountEstimate estimate;
      for (int i = 0; i < 10; ++i) estimate.add(seenFrom(key(0.6, pitch, roll)), kDepth);
      const Mount mount = estimate.mount();
      EXPECT_NEAR(mount.height, 0.6, 1e-12);
      EXPECT_NEAR(mount.pitch, pitch, 1e-12);
      EXPECT_NEAR(mount.roll, roll, 1e-12);
      // The transform that goes into a launch file puts the depth camera where it is: camera_link
      // by height, pitch and roll, the depth camera 2 cm to its right.
      const Eigen::Isometry3d link =
          Eigen::Translation3d(0.0, 0.0, mount.linkHeight()) *
          Eigen::Isometry3d(Eigen::AngleAxisd(mount.pitch, Eigen::Vector3d::UnitY()) *
                            Eigen::AngleAxisd(mount.roll, Eigen::Vector3d::UnitX()));
      EXPECT_NEAR((link * Eigen::Vector3d(0.0, -0.02, 0.0)).z(), 0.6, 1e-12);
    }
  }
}

TEST(MountEstimateTest, LaunchTextIsOfTheLinkAndRounded) {
  Mount mount;
  mount.height = 0.45;
  mount.pitch = 0.22004;
  mount.roll = -0.00001;
  const std::string text = mount.launchText();
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "mount_height:=0.4500 mount_pitch:=0.2200 mount_roll:=0.0000");
  EXPECT_NE(text.find("args=\"0 0 0.4500 0 0.2200 0.0000 base_link camera_link\""),
            std::string::npos)
      << text;
}

TEST(MountEstimateTest, ErrorsAreThoseOfTheMean) {
  std::mt19937 generator(2);
  std::normal_distribution<double> normal;
  int within_one = 0, within_three = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    MountEstimate estimate;
    for (int i = 0; i < 100; ++i) {
      estimate.add(seenFrom(key(0.5 + 0.002 * normal(generator), 0.3 + 0.003 * normal(generator),
                                0.1 + 0.003 * normal(generator))),
                   kDepth);
    }
    const Mount mount = estimate.mount();
    within_one += std::abs(mount.height - 0.5) < mount.height_error ? 1 : 0;
    within_three += std::abs(mount.pitch - 0.3) < 3.0 * mount.pitch_error ? 1 : 0;
    EXPECT_LT(mount.height_error, 0.0005);
    EXPECT_LT(mount.roll_error, 0.001);
  }
  EXPECT_NEAR(within_one, 0.66 * kTrials, 0.1 * kTrials);  // Student's t with 9 degrees of freedom
  EXPECT_GT(within_three, 0.96 * kTrials);
}

TEST(MountEstimateTest, RefusesAPlaneThatMoves) {
  MountEstimate rising, nodding, leaning;
  for (int i = 0; i < 50; ++i) {
    rising.add(seenFrom(key(0.5 + 0.001 * i, 0.3, 0.0)), kDepth);
    nodding.add(seenFrom(key(0.5, 0.3 + 0.1 * std::sin(0.3 * i), 0.0)), kDepth);
    leaning.add(seenFrom(key(0.5, 0.3, 0.003 * i)), kDepth);
  }
  EXPECT_NE(problemOf(rising).find("moves"), std::string::npos) << problemOf(rising);
  EXPECT_NE(problemOf(nodding).find("moves"), std::string::npos) << problemOf(nodding);
  EXPECT_NE(problemOf(leaning).find("moves"), std::string::npos) << problemOf(leaning);
}

TEST(MountEstimateTest, RefusesAPlaneThatIsNotDominant) {
  MountEstimate few, missing, small;
  for (int i = 0; i < 5; ++i) few.add(seenFrom(key(0.5, 0.3, 0.0)), kDepth);
  EXPECT_NE(problemOf(few).find("at least 10"), std::string::npos) << problemOf(few);
  Detection none;
  none.reason = "There is none.";
  for (int i = 0; i < 50; ++i) {
    missing.add(i % 5 == 0 ? none : seenFrom(key(0.5, 0.3, 0.0)), kDepth);
    small.add(seenFrom(key(0.5, 0.3, 0.0), 0.3), kDepth);
  }
  EXPECT_NE(problemOf(missing).find("40 of 50: There is none."), std::string::npos)
      << problemOf(missing);
  EXPECT_NE(problemOf(small).find("30 % of the readings"), std::string::npos) << problemOf(small);
}

/// Registered depth is seen from the colour camera, 4.5 cm to the right of camera_link.
TEST(MountEstimate, TheLinkIsWhereTheFrameOfTheImagesSays) {
  EXPECT_EQ(linkOffsetOf("camera_depth_optical_frame"), 0.02);
  EXPECT_EQ(linkOffsetOf("left_rgb_optical_frame"), 0.045);
  EXPECT_EQ(linkOffsetOf("rgb"), 0.02);
  EXPECT_EQ(linkOffsetOf(""), 0.02);
  MountEstimate registered;
  for (int i = 0; i < 10; ++i) {
    registered.add(seenFrom(key(0.6, 0.2, 0.3)), "camera_rgb_optical_frame");
  }
  const Mount mount = registered.mount();
  EXPECT_NEAR(mount.linkHeight(), 0.6 + 0.045 * std::cos(0.2) * std::sin(0.3), 1e-9);
}

}  // namespace
}  // namespace dominant_plane_detection
