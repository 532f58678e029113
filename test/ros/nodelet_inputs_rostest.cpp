// What the nodelet takes: every kind of depth image, clouds, and what it has to survive.

#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <pcl_conversions/pcl_conversions.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/ray_table.h"
#include "nodelet_fixture.h"

namespace dominant_plane_detection {
namespace {

TEST_F(Nodelet, EveryKindOfDepthImage) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  expectTruth(detect(planes, image_));

  sensor_msgs::Image padded = image_;
  padded.step += 6;
  padded.data.assign(padded.step * padded.height, 77);
  for (std::uint32_t v = 0; v < padded.height; ++v) {
    std::copy_n(image_.data.begin() + v * image_.step, image_.step,
                padded.data.begin() + v * padded.step);
  }
  expectTruth(detect(planes, padded));

  sensor_msgs::Image big_endian = image_;
  big_endian.is_bigendian = 1;
  for (std::size_t i = 0; i < big_endian.data.size(); i += 2) {
    std::swap(big_endian.data[i], big_endian.data[i + 1]);
  }
  expectTruth(detect(planes, big_endian));

  OwnedDepth<float> metres = sceneMetres();
  for (float& z : metres.pixels) {
    if (z == 0.0F) z = std::numeric_limits<float>::quiet_NaN();
  }
  sensor_msgs::Image floats = image_;
  floats.encoding = "32FC1";
  floats.step = 4 * floats.width;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(metres.pixels.data());
  floats.data.assign(bytes, bytes + floats.step * floats.height);
  expectTruth(detect(planes, floats));
}

TEST_F(Nodelet, MalformedImagesAreSurvived) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  expectTruth(detect(planes, image_));
  const std::size_t before = planes.size();
  sensor_msgs::Image bad = image_;
  bad.data.resize(1000);
  send(bad);
  bad = image_;
  bad.encoding = "bayer_rggb8";
  send(bad);
  bad = image_;
  bad.width = 0;
  send(bad);
  bad = image_;
  bad.height = 240;  // no longer the camera_info's
  bad.data.resize(bad.step * bad.height);
  send(bad);
  expectTruth(detect(planes, image_));
  EXPECT_EQ(planes.size(), before + 1);
}

TEST_F(Nodelet, NoPlaneIsAnAnswerToEveryImage) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  sensor_msgs::Image empty = image_;
  std::fill(empty.data.begin(), empty.data.end(), 0);
  for (int i = 0; i < 10; ++i) {
    const auto plane = detect(planes, empty);
    ASSERT_TRUE(plane);
    EXPECT_EQ(plane->state, DominantPlane::NO_DEPTH);
    EXPECT_NE(plane->reason.find("640 x 480"), std::string::npos) << plane->reason;
    EXPECT_TRUE(std::isnan(plane->distance));
  }
  EXPECT_EQ(planes.size(), 10U);
}

TEST_F(Nodelet, CameraInfoWithOtherStampsDoesNotSilenceIt) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  ros::Time last;
  const auto answered = [&] { return planes.size() > 0 && planes.last()->header.stamp == last; };
  const ros::SteadyTime start = ros::SteadyTime::now();
  // Image after image, a little apart, until one is answered.
  ASSERT_TRUE(spinUntil([&] {
    last = send(image_, 0.004);
    return spinUntil(answered, 0.1);
  }));
  EXPECT_GE((ros::SteadyTime::now() - start).toSec(), 1.0);
  expectTruth(planes.last());
}

TEST_F(Nodelet, HearsAListenerThatWasThereBeforeIt) {
  ASSERT_TRUE(ros::service::waitForService("/manager/load_nodelet", 20000));
  for (int round = 0; round < 10; ++round) {
    Listener<DominantPlane> planes(node_, "/later_detection/plane");
    nodelet::NodeletLoad load;
    load.request.name = "/later_detection";
    load.request.type = "dominant_plane_detection/PlaneDetection";
    ASSERT_TRUE(ros::service::call("/manager/load_nodelet", load) && load.response.success);
    EXPECT_TRUE(waitForSubscription()) << "round " << round;
    expectTruth(detect(planes, image_));
    nodelet::NodeletUnload unload;
    unload.request.name = "/later_detection";
    ASSERT_TRUE(ros::service::call("/manager/unload_nodelet", unload) && unload.response.success);
    ASSERT_TRUE(spinUntil([&] { return images_.getNumSubscribers() == 0; }));
  }
}

TEST_F(Nodelet, UnloadsAndLoadsAgainWhileImagesFlow) {
  ASSERT_TRUE(ros::service::waitForService("/manager/load_nodelet", 20000));
  for (int round = 0; round < 5; ++round) {
    nodelet::NodeletLoad load;
    load.request.name = "/reloaded_detection";
    load.request.type = "dominant_plane_detection/PlaneDetection";
    ASSERT_TRUE(ros::service::call("/manager/load_nodelet", load) && load.response.success);
    Listener<DominantPlane> planes(node_, "/reloaded_detection/plane");
    ASSERT_TRUE(spinUntil([&] { return planes.connected(); }));
    ASSERT_TRUE(waitForSubscription());
    // Unloaded in the middle of the next images.
    ASSERT_TRUE(spinUntil([&] {
      send(image_);
      return planes.size() >= 3;
    }));
    expectTruth(planes.last());
    for (int i = 0; i < 3; ++i) send(image_);
    nodelet::NodeletUnload unload;
    unload.request.name = "/reloaded_detection";
    ASSERT_TRUE(ros::service::call("/manager/unload_nodelet", unload) && unload.response.success);
  }
}

class Clouds : public Nodelet {
 protected:
  Clouds() : clouds_(node_.advertise<sensor_msgs::PointCloud2>("/points", 10)) {
    const OwnedDepth<float> depth = sceneMetres();
    RayTable rays;
    rays.build(testCamera());
    pcl::PointCloud<pcl::PointXYZ> points(640, 480);
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) {
        const Eigen::Vector3f point = metresAt(depth.view(), u, v) * rays.ray(u, v);
        points.at(u, v) = {point.x(), point.y(), point.z()};
      }
    }
    pcl::toROSMsg(points, cloud_);
    cloud_.header.frame_id = "optical";
  }
  ros::Time sendCloud(sensor_msgs::PointCloud2 cloud) {
    cloud.header.stamp = nextStamp();
    clouds_.publish(cloud);
    return cloud.header.stamp;
  }
  void expectPlane(const Listener<DominantPlane>& planes) {
    const ros::Time stamp = sendCloud(cloud_);
    ASSERT_TRUE(
        spinUntil([&] { return planes.size() > 0 && planes.last()->header.stamp == stamp; }));
    expectTruth(planes.last());
  }

  ros::Publisher clouds_;
  sensor_msgs::PointCloud2 cloud_;
};

TEST_F(Clouds, GiveTheSamePlane) {
  Listener<DominantPlane> planes(node_, "/points_detection/plane");
  ASSERT_TRUE(spinUntil([&] { return clouds_.getNumSubscribers() > 0 && planes.connected(); }));
  expectPlane(planes);
}

TEST_F(Clouds, WhoseSizesContradictEachOtherAreSurvived) {
  Listener<DominantPlane> planes(node_, "/points_detection/plane");
  ASSERT_TRUE(spinUntil([&] { return clouds_.getNumSubscribers() > 0 && planes.connected(); }));
  expectPlane(planes);
  const std::size_t before = planes.size();
  sensor_msgs::PointCloud2 bad = cloud_;
  bad.width = 4;  // far less than there is data
  bad.height = 3;
  sendCloud(bad);
  bad = cloud_;
  bad.data.resize(1000);
  sendCloud(bad);
  bad = cloud_;
  bad.data.resize(2 * bad.data.size());
  bad.row_step *= 1000;
  sendCloud(bad);
  bad = cloud_;
  bad.point_step = 0;
  sendCloud(bad);
  bad = cloud_;
  bad.fields[2].offset = 1000000;
  sendCloud(bad);
  bad = cloud_;
  bad.fields.clear();
  sendCloud(bad);
  expectPlane(planes);
  EXPECT_EQ(planes.size(), before + 1);
}

}  // namespace
}  // namespace dominant_plane_detection
