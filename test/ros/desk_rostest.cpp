// A recording of a camera in the hand, whose pose motion capture tells by tf, in real time.

#include <dominant_plane_detection/DominantPlane.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <iostream>

#include "support/desk_truth.h"
#include "support/recordings.h"
#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = M_PI / 180.0;

/// Sends a bag's messages as far apart as they were recorded, and later where the answer to the
/// image before is: on a busy machine none is overtaken.
void play(const std::string& file, ros::NodeHandle& node, const Listener<DominantPlane>& planes) {
  const auto images = node.advertise<sensor_msgs::Image>("/camera/depth/image_raw", 50);
  const auto infos = node.advertise<sensor_msgs::CameraInfo>("/camera/depth/camera_info", 50);
  const auto transforms = node.advertise<tf2_msgs::TFMessage>("/tf", 50);
  ASSERT_TRUE(spinUntil([&] {
    return planes.connected() && images.getNumSubscribers() > 0 && infos.getNumSubscribers() > 0 &&
           transforms.getNumSubscribers() > 1;  // this program is one
  }));
  rosbag::Bag bag(file, rosbag::bagmode::Read);
  rosbag::View view(bag);
  const ros::SteadyTime start = ros::SteadyTime::now();
  ros::Time last;
  const auto answered = [&] { return planes.size() > 0 && planes.last()->header.stamp == last; };
  for (const rosbag::MessageInstance& message : view) {
    const double due = patience() * (message.getTime() - view.getBeginTime()).toSec();
    spinUntil([&] { return (ros::SteadyTime::now() - start).toSec() >= due; });
    if (message.isType<sensor_msgs::Image>() && !last.isZero()) EXPECT_TRUE(spinUntil(answered));
    if (auto info = message.instantiate<sensor_msgs::CameraInfo>()) infos.publish(info);
    if (auto pose = message.instantiate<tf2_msgs::TFMessage>()) transforms.publish(pose);
    if (auto image = message.instantiate<sensor_msgs::Image>()) {
      images.publish(image);
      last = image->header.stamp;
    }
  }
  EXPECT_TRUE(spinUntil(answered));  // with its publishers the last message may go
}

TEST(Desk, MotionCaptureTellsFloorAndTableFromWalls) {
  const std::string file = recordingsFolder() + "/handheld_desk.bag";
  const std::vector<DeskTruth> truths = readDeskTruth();
  if (!std::filesystem::exists(file) || truths.empty()) {
    GTEST_SKIP() << "no " << file << "; set DPD_RECORDINGS to the folder with the recordings";
  }
  ros::NodeHandle node;
  Listener<DominantPlane> planes(node, "/plane_detection/plane");
  tf2_ros::Buffer buffer;
  const tf2_ros::TransformListener listener(buffer);
  play(file, node, planes);
  EXPECT_TRUE(spinUntil([&] { return planes.size() >= truths.size(); }));

  int images = 0, right = 0, by_tf = 0;
  ASSERT_EQ(planes.size(), truths.size());
  for (const auto& plane : planes.messages()) {
    const DeskTruth* const truth = findTruth(truths, plane->header.stamp.toSec());
    ASSERT_TRUE(truth);
    by_tf += plane->up_source == DominantPlane::UP_TF;
    if (std::max(truth->on_floor, truth->on_table) < 0.2) continue;
    ++images;
    if (plane->state != DominantPlane::FOUND) continue;
    const Eigen::Vector3d normal(plane->normal.x, plane->normal.y, plane->normal.z);
    const double tilt = std::acos(std::min(1.0, normal.dot(truth->up.normalized())));
    EXPECT_LT(tilt, 45.0 * kDegree) << "a wall";
    const double off = std::min(std::abs(plane->distance - truth->floor),
                                std::abs(plane->distance - truth->table));
    right += tilt < 10.0 * kDegree && off < 0.06;
  }
  std::cout << "floor or table in " << right << " of " << images << " images, up by tf in " << by_tf
            << "\n";
  EXPECT_GE(right, std::ceil(0.97 * images));
  // The first images come while transforms are not known yet.
  EXPECT_GE(by_tf, 140);
  // The ground of the last image, in the world: level, and as high as floor or table.
  const auto& last = *planes.last();
  ASSERT_TRUE(spinUntil([&] { return buffer.canTransform("world", "ground", last.header.stamp); }));
  const auto ground = buffer.lookupTransform("world", "ground", last.header.stamp).transform;
  const Eigen::Quaterniond turn(ground.rotation.w, ground.rotation.x, ground.rotation.y,
                                ground.rotation.z);
  EXPECT_GT((turn * Eigen::Vector3d::UnitZ()).z(), std::cos(10.0 * kDegree));
  EXPECT_LT(std::min(std::abs(ground.translation.z - 0.02), std::abs(ground.translation.z - 0.77)),
            0.08);
}

}  // namespace
}  // namespace dominant_plane_detection
