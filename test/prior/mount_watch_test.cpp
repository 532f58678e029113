#include "prior/mount_watch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dominant_plane_detection {
namespace {

/// A camera 0.5 m up that looks ahead: T_base_camera.
Eigen::Isometry3d mount() {
  Eigen::Isometry3d camera = Eigen::Isometry3d::Identity();
  camera.linear() = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5).toRotationMatrix();
  camera.translation().z() = 0.5;
  return camera;
}

Detection floorAt(double distance) {
  Detection detection;
  detection.state = State::kFound;
  detection.normal = -Eigen::Vector3d::UnitY();
  detection.distance = distance;
  return detection;
}

TEST(MountedGround, IsUpAndTheCamerasHeight) {
  const MountedGround ground = mountedGround(mount());
  EXPECT_LT((ground.up.direction + Eigen::Vector3d::UnitY()).norm(), 1e-9);
  ASSERT_TRUE(ground.height);
  EXPECT_NEAR(ground.height->height, 0.5, 1e-9);
  EXPECT_NEAR(ground.height->tolerance, 0.125, 1e-9);
  Eigen::Isometry3d below = mount();
  below.translation().z() = -0.1;
  EXPECT_FALSE(mountedGround(below).height);
}

TEST(MountWatch, TellsAPlaneThatStaysAtAnotherHeight) {
  MountWatch watch("base");
  const auto height = mountedGround(mount()).height;
  watch.add(0.0, floorAt(0.55), mount(), height);
  for (int i = 1; i <= 15; ++i) {
    EXPECT_EQ(watch.text(), "") << i;
    watch.add(i / 30.0, floorAt(0.2), mount(), height);
  }
  EXPECT_NE(watch.text().find("0.30 m above where tf has the ground of base"), std::string::npos)
      << watch.text();
  EXPECT_TRUE(watch.isOfHeight());
  EXPECT_EQ(watch.heights().expected, 1U);
  EXPECT_EQ(watch.heights().others, 15U);
  // It is over a second after the last plane, or with one where it should be.
  watch.add(1.4, Detection(), mount(), height);
  EXPECT_NE(watch.text(), "");
  watch.add(1.6, Detection(), mount(), height);
  EXPECT_EQ(watch.text(), "");
  EXPECT_FALSE(watch.isOfHeight());
  watch.forget();
  EXPECT_EQ(watch.heights().others, 0U);
}

TEST(MountWatch, WithoutTfOfTheVeryTimeThereIsNothingToSay) {
  MountWatch watch("base");
  const auto height = mountedGround(mount()).height;
  for (int i = 0; i < 30; ++i) watch.add(i / 30.0, floorAt(0.2), std::nullopt, height);
  EXPECT_EQ(watch.text(), "");
  EXPECT_EQ(watch.heights().others, 0U);
}

}  // namespace
}  // namespace dominant_plane_detection
