// pioneer.launch with the virtual Kinect: topics, frames and what is seen.

#include <dominant_plane_detection/DominantPlane.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>
#include <tf2_ros/transform_listener.h>
#include <visualization_msgs/MarkerArray.h>

#include <Eigen/Geometry>
#include <cmath>

#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

TEST(Pioneer, SeesTheFloorWhereItsMountSaysItIs) {
  ros::NodeHandle node("/camera/plane_detection");
  Listener<DominantPlane> planes(node, "plane");
  Listener<sensor_msgs::Image> overlays(node, "overlay");
  Listener<visualization_msgs::MarkerArray> markers(node, "markers");
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener transforms(buffer);
  ASSERT_TRUE(spinUntil(
      [&] { return planes.size() >= 20 && overlays.size() >= 5 && markers.size() >= 5; }, 60.0));
  const DominantPlane& plane = *planes.last();
  ASSERT_EQ(plane.state, DominantPlane::FOUND) << plane.reason;
  EXPECT_EQ(plane.header.frame_id, "camera_rgb_optical_frame") << "registered to colour";
  ASSERT_TRUE(spinUntil(
      [&] { return buffer.canTransform("base_link", plane.header.frame_id, ros::Time(0)); }));
  const auto message = buffer.lookupTransform("base_link", plane.header.frame_id, ros::Time(0));
  const auto& q = message.transform.rotation;
  const Eigen::Vector3d up = Eigen::Quaterniond(q.w, q.x, q.y, q.z) *
                             Eigen::Vector3d(plane.normal.x, plane.normal.y, plane.normal.z);
  // base_link is on the floor: the camera's height in it is that over the plane.
  EXPECT_LT(std::acos(std::min(up.z(), 1.0)), 0.2 * M_PI / 180.0);
  EXPECT_NEAR(message.transform.translation.z, plane.distance, 0.003);
  EXPECT_TRUE(ros::param::has("/robot_description"));

  const sensor_msgs::Image& overlay = *overlays.last();
  ASSERT_EQ(overlay.encoding, "bgr8");
  const auto* nearest = &overlay.data[std::size_t{470} * overlay.step + 3 * 320];
  EXPECT_EQ(nearest[0] + nearest[1] + nearest[2], 0) << "the ground is painted black";
  EXPECT_EQ(markers.last()->markers.size(), 2U);
}

}  // namespace
}  // namespace dominant_plane_detection
