// What record.launch writes is what replay needs: depth with its camera_info, and the picture.

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <filesystem>
#include <set>

#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kBag = "/tmp/dpd_record_test.bag";  // of record.test

TEST(Record, WritesWhatReplayNeeds) {
  ros::NodeHandle node;
  Listener<sensor_msgs::Image> images(node, "/camera/depth/image_raw");
  Listener<sensor_msgs::Image> pictures(node, "/camera/rgb/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 60 && pictures.size() >= 60; }, 60.0));
  // The recorder ends its bag when its node is shut down.
  ASSERT_EQ(std::system("rosnode kill /recorder > /dev/null"), 0);
  ASSERT_TRUE(spinUntil([] { return std::filesystem::exists(kBag); }));

  rosbag::Bag bag(kBag, rosbag::bagmode::Read);
  std::set<std::string> topics;
  std::set<ros::Time> depth, infos;
  rosbag::View all(bag);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    topics.insert(connection->topic);
  }
  EXPECT_EQ(topics, (std::set<std::string>{"/camera/depth/camera_info", "/camera/depth/image_raw",
                                           "/camera/rgb/image_raw", "/tf_static"}));
  rosbag::View depth_view(bag, rosbag::TopicQuery("/camera/depth/image_raw"));
  for (const auto& message : depth_view) {
    const auto image = message.instantiate<sensor_msgs::Image>();
    ASSERT_TRUE(image);
    EXPECT_EQ(image->encoding, "16UC1");
    depth.insert(image->header.stamp);
  }
  rosbag::View info_view(bag, rosbag::TopicQuery("/camera/depth/camera_info"));
  for (const auto& message : info_view) {
    infos.insert(message.instantiate<sensor_msgs::CameraInfo>()->header.stamp);
  }
  EXPECT_GE(depth.size(), 20U);
  std::size_t matching = 0;
  for (const ros::Time& stamp : depth) matching += infos.count(stamp);
  EXPECT_GE(matching, depth.size() - 2) << "the ends may be cut between the two";
  std::filesystem::remove(kBag);
}

}  // namespace
}  // namespace dominant_plane_detection
