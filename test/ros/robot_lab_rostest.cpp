// The nodelet on a real recording, in real time: every image gets its plane, and it is right.

#include <dominant_plane_detection/DominantPlane.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "support/ros_test.h"
#include "support/scoring.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kImages = "/camera/depth/image_raw";
constexpr const char* kInfos = "/camera/depth/camera_info";

struct Recording {
  std::vector<sensor_msgs::ImageConstPtr> images;
  std::vector<sensor_msgs::CameraInfoConstPtr> infos;
};

Recording readBag(const std::string& file) {
  Recording recording;
  rosbag::Bag bag(file, rosbag::bagmode::Read);
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{kImages, kInfos}));
  for (const rosbag::MessageInstance& message : view) {
    if (auto image = message.instantiate<sensor_msgs::Image>()) recording.images.push_back(image);
    if (auto info = message.instantiate<sensor_msgs::CameraInfo>()) recording.infos.push_back(info);
  }
  return recording;
}

/// Sends image and camera_info pairs as far apart as their stamps are.
void play(const Recording& recording, const ros::Publisher& images, const ros::Publisher& infos) {
  const ros::SteadyTime start = ros::SteadyTime::now();
  const ros::Time first = recording.images.front()->header.stamp;
  for (std::size_t i = 0; i < recording.images.size(); ++i) {
    const double due = patience() * (recording.images[i]->header.stamp - first).toSec();
    spinUntil([&] { return (ros::SteadyTime::now() - start).toSec() >= due; });
    images.publish(recording.images[i]);
    infos.publish(recording.infos[i]);
  }
}

/// A detection as far as messages tell it.
Detection asDetection(const DominantPlane& plane, const sensor_msgs::Image& mask) {
  Detection detection;
  detection.state = static_cast<State>(plane.state);
  detection.normal = {plane.normal.x, plane.normal.y, plane.normal.z};
  detection.distance = plane.distance;
  detection.image_width = static_cast<int>(mask.width);
  detection.image_height = static_cast<int>(mask.height);
  for (const std::uint8_t pixel : mask.data) {
    detection.labels.push_back(
        static_cast<std::uint8_t>(pixel == 255 ? Label::kGround : Label::kUnknown));
  }
  return detection;
}

TEST(RobotLab, EveryImageGetsItsPlaneAndItIsRight) {
  const std::string file = recordingsFolder() + "/robot_lab.bag";
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "no " << file << "; set DPD_RECORDINGS to the folder with the recordings";
  }
  const Recording recording = readBag(file);
  ASSERT_EQ(recording.images.size(), 120U);
  ASSERT_EQ(recording.infos.size(), 120U);
  const ReferenceSet reference = loadRobotLab();
  ASSERT_EQ(reference.images.size(), 24U);

  ros::NodeHandle node;
  const ros::Publisher images = node.advertise<sensor_msgs::Image>(kImages, 10);
  const ros::Publisher infos = node.advertise<sensor_msgs::CameraInfo>(kInfos, 10);
  Listener<DominantPlane> planes(node, "/plane_detection/plane");
  Listener<sensor_msgs::Image> masks(node, "/plane_detection/ground_mask");
  ASSERT_TRUE(spinUntil([&] {
    return images.getNumSubscribers() > 0 && infos.getNumSubscribers() > 0 && planes.connected() &&
           masks.connected();
  }));
  play(recording, images, infos);
  EXPECT_TRUE(spinUntil([&] { return planes.size() >= 120 && masks.size() >= 120; }));
  ASSERT_EQ(planes.size(), 120U);
  ASSERT_EQ(masks.size(), 120U);

  for (std::size_t i = 0; i < 120; ++i) {
    EXPECT_EQ(planes.messages()[i]->header.stamp, recording.images[i]->header.stamp);
    EXPECT_EQ(planes.messages()[i]->header.frame_id, recording.images[i]->header.frame_id);
    EXPECT_EQ(masks.messages()[i]->header.stamp, recording.images[i]->header.stamp);
    EXPECT_EQ(planes.messages()[i]->state, DominantPlane::FOUND) << planes.messages()[i]->reason;
  }
  double worst_height = 0.0, worst_angle = 0.0, worst_iou = 1.0;
  for (const ReferenceImage& truth : reference.images) {
    const auto i = static_cast<std::size_t>(std::stoi(truth.name));
    const Score result =
        score(asDetection(*planes.messages()[i], *masks.messages()[i]), reference, truth);
    EXPECT_LE(result.height, 0.005) << "image " << i;
    EXPECT_LE(result.angle, 0.5 * M_PI / 180.0) << "image " << i;
    EXPECT_GE(result.iou, 0.95) << "image " << i;
    worst_height = std::max(worst_height, result.height);
    worst_angle = std::max(worst_angle, result.angle);
    worst_iou = std::min(worst_iou, result.iou);
  }
  std::cout << "worst of " << reference.images.size() << ": height " << 1e3 * worst_height
            << " mm, normal " << worst_angle * 180.0 / M_PI << " deg, IoU " << worst_iou
            << std::endl;
}

}  // namespace
}  // namespace dominant_plane_detection
