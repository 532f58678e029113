#pragma once

#include <dominant_plane_detection/DominantPlane.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "support/ros_test.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {

inline const Eigen::Vector3d kUp = upOf(0.6, 0.1);
constexpr double kHeight = 0.8;  // [m]
constexpr double kBox = 0.24;    // [m] height of what is seen at 0.7 of the floor's depth

/// A floor with a box on it.
inline OwnedDepth<float> sceneMetres() {
  OwnedDepth<float> depth = planeDepth(testCamera(), kUp, kHeight);
  for (int v = 200; v < 260; ++v) {
    for (int u = 300; u < 360; ++u) depth.at(u, v) *= 0.7F;
  }
  return depth;
}

inline sensor_msgs::Image message(const OwnedDepth<std::uint16_t>& depth) {
  sensor_msgs::Image image;
  image.encoding = "16UC1";
  image.width = static_cast<std::uint32_t>(depth.width);
  image.height = static_cast<std::uint32_t>(depth.height);
  image.step = 2 * image.width;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(depth.pixels.data());
  image.data.assign(bytes, bytes + image.step * image.height);
  return image;
}

inline sensor_msgs::CameraInfo cameraInfo() {
  const CameraModel camera = testCamera();
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

/// Sends depth images to the nodelet of nodelet.test.
class Nodelet : public testing::Test {
 protected:
  Nodelet()
      : images_(node_.advertise<sensor_msgs::Image>("/depth/image_raw", 10)),
        infos_(node_.advertise<sensor_msgs::CameraInfo>("/depth/camera_info", 10)),
        image_(message(inMillimetres(sceneMetres()))) {}

  bool waitForSubscription() {
    return spinUntil(
        [&] { return images_.getNumSubscribers() > 0 && infos_.getNumSubscribers() > 0; });
  }
  /// A stamp that no other message of this program has.
  static ros::Time nextStamp() {
    static std::uint32_t seconds = 1000;
    return ros::Time(++seconds, 0);
  }
  ros::Time send(sensor_msgs::Image image, double info_offset = 0.0) {
    image.header.stamp = nextStamp();
    image.header.frame_id = "optical";
    sensor_msgs::CameraInfo info = cameraInfo();
    info.header.frame_id = "optical";
    info.header.stamp = image.header.stamp + ros::Duration(info_offset);
    infos_.publish(info);
    images_.publish(image);
    return image.header.stamp;
  }
  /// Sends an image and waits for the plane with its stamp.
  DominantPlaneConstPtr detect(const Listener<DominantPlane>& planes,
                               const sensor_msgs::Image& image) {
    const ros::Time stamp = send(image);
    const auto answered = [&] { return planes.size() > 0 && planes.last()->header.stamp == stamp; };
    return spinUntil(answered) ? planes.last() : nullptr;
  }
  static void expectTruth(const DominantPlaneConstPtr& plane) {
    ASSERT_TRUE(plane);
    ASSERT_EQ(plane->state, DominantPlane::FOUND) << plane->reason;
    EXPECT_NEAR(plane->normal.x, kUp.x(), 0.001);
    EXPECT_NEAR(plane->normal.y, kUp.y(), 0.001);
    EXPECT_NEAR(plane->normal.z, kUp.z(), 0.001);
    EXPECT_NEAR(plane->distance, kHeight, 0.001);
    EXPECT_EQ(plane->header.frame_id, "optical");
    EXPECT_GT(plane->processing_time, 0.0F);
  }

  ros::NodeHandle node_;
  ros::Publisher images_;
  ros::Publisher infos_;
  sensor_msgs::Image image_;
};

}  // namespace dominant_plane_detection
