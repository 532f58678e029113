// What record.launch writes is what replay needs: depth with its camera_info, and the picture.

#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <set>

#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;

/// record.launch as users start it, with a bag in a folder whose name has blanks.
class Record : public testing::Test {
 protected:
  Record() : folder_(fs::temp_directory_path() / ("dpd record " + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Record() override { fs::remove_all(folder_); }

  std::string bag() const { return folder_ / "drive of today.bag"; }
  std::future<int> launch(const std::string& bag, const std::string& more = "") const {
    const std::string command = "roslaunch " DPD_SOURCE "/launch/record.launch \"bag:=" + bag +
                                "\" " + more + " > \"" + log() + "\" 2>&1";
    return std::async(std::launch::async, [command] { return std::system(command.c_str()); });
  }
  std::string log() const { return folder_ / "roslaunch.log"; }
  /// Records until both topics have brought some messages more.
  void record(const std::string& depth, const std::string& more) {
    auto launched = launch(bag(), more);
    ASSERT_TRUE(spinUntil([&] { return fs::exists(bag() + ".active"); }, 60.0));
    Listener<sensor_msgs::Image> images(node_, depth + "/image_raw");
    Listener<sensor_msgs::Image> pictures(node_, "/camera/rgb/image_raw");
    ASSERT_TRUE(spinUntil([&] { return images.size() >= 60 && pictures.size() >= 60; }, 60.0));
    // The recorder ends its bag when its node is shut down, and the launch with it.
    ASSERT_EQ(std::system("rosnode kill /recorder > /dev/null"), 0);
    ASSERT_TRUE(spinUntil([&] { return isReady(launched); }, 60.0));
    ASSERT_TRUE(fs::exists(bag()));
  }
  template <typename Message>
  std::set<ros::Time> stampsOf(const std::string& topic) const {
    const rosbag::Bag bag(this->bag(), rosbag::bagmode::Read);
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    std::set<ros::Time> stamps;
    for (const auto& message : view) {
      stamps.insert(message.instantiate<Message>()->header.stamp);
    }
    return stamps;
  }
  /// While both were recorded, each image has its camera_info.
  void expectPairs(const std::string& depth) const {
    const auto images = stampsOf<sensor_msgs::Image>(depth + "/image_raw");
    const auto infos = stampsOf<sensor_msgs::CameraInfo>(depth + "/camera_info");
    ASSERT_GE(images.size(), 20U);
    ASSERT_GE(infos.size(), 20U);
    const ros::Time begin = std::max(*images.begin(), *infos.begin());
    const ros::Time end = std::min(*images.rbegin(), *infos.rbegin());
    for (const ros::Time& stamp : images) {
      if (stamp >= begin && stamp <= end) {
        EXPECT_EQ(infos.count(stamp), 1U) << stamp;
      }
    }
  }

  ros::NodeHandle node_;
  fs::path folder_;
};

TEST_F(Record, WritesWhatReplayNeeds) {
  record("/camera/depth", "");
  const rosbag::Bag bag(this->bag(), rosbag::bagmode::Read);
  rosbag::View all(bag);
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    topics.insert(connection->topic);
  }
  EXPECT_EQ(topics,
            (std::set<std::string>{"/camera/depth/camera_info", "/camera/depth/image_raw",
                                   "/camera/imu/data_raw", "/camera/rgb/image_raw", "/tf_static"}));
  expectPairs("/camera/depth");
}

TEST_F(Record, WritesRegisteredDepthWhereThatIsWhatThereIs) {
  dynamic_reconfigure::Reconfigure call;
  dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, "depth_registration",
                                                    true);
  ASSERT_TRUE(ros::service::call("/camera/driver/set_parameters", call));
  record("/camera/depth_registered", "registration:=true");
  expectPairs("/camera/depth_registered");
}

TEST_F(Record, EndsWhereNothingCanBeWritten) {
  auto launched = launch("/no such folder/drive.bag");
  ASSERT_TRUE(spinUntil([&] { return isReady(launched); }, 60.0));
  std::ifstream file(log());
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(text.find("REQUIRED process [recorder"), std::string::npos) << text;
}

}  // namespace
}  // namespace dominant_plane_detection
