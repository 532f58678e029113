// A rendered drive through replay.launch: the published plane against the scene's truth.

#include <dominant_plane_detection/DominantPlane.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

std::map<ros::Time, DominantPlaneConstPtr> byStamp(const Listener<DominantPlane>& listener) {
  std::map<ros::Time, DominantPlaneConstPtr> planes;
  for (const auto& plane : listener.messages()) planes[plane->header.stamp] = plane;
  return planes;
}

TEST(SyntheticBag, ThePlaneIsTheScenesAllAlongTheDrive) {
  constexpr std::size_t kImages = 61;  // two seconds at 30 Hz, and the last
  ros::NodeHandle node;
  Listener<DominantPlane> planes(node, "/plane_detection/plane");
  Listener<DominantPlane> truths(node, "/truth/plane");
  ASSERT_TRUE(spinUntil(
      [&] { return byStamp(planes).size() >= kImages && byStamp(truths).size() >= kImages; },
      60.0));
  const auto detected = byStamp(planes);
  EXPECT_EQ(detected.size(), kImages);
  for (const auto& [stamp, truth] : byStamp(truths)) {
    ASSERT_EQ(detected.count(stamp), 1U) << stamp;
    const DominantPlane& plane = *detected.at(stamp);
    ASSERT_EQ(plane.state, DominantPlane::FOUND) << plane.reason;
    EXPECT_NEAR(plane.distance, truth->distance, 0.003);
    const double dot = plane.normal.x * truth->normal.x + plane.normal.y * truth->normal.y +
                       plane.normal.z * truth->normal.z;
    EXPECT_LT(std::acos(std::min(dot, 1.0)), 0.2 * M_PI / 180.0);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
