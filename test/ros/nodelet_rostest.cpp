// The nodelet's topics, inputs and parameters, on a scene whose truth is known.

#include <dominant_plane_detection/DominantPlane.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <pcl_conversions/pcl_conversions.h>
#include <pcl_msgs/ModelCoefficients.h>
#include <pcl_ros/point_cloud.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <limits>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/ros_test.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

const Eigen::Vector3d kUp = upOf(0.6, 0.1);
constexpr double kHeight = 0.8;  // [m]
constexpr double kBox = 0.24;    // [m] height of what is seen at 0.7 of the floor's depth

/// A floor with a box on it.
OwnedDepth<float> sceneMetres() {
  OwnedDepth<float> depth = planeDepth(testCamera(), kUp, kHeight);
  for (int v = 200; v < 260; ++v) {
    for (int u = 300; u < 360; ++u) depth.at(u, v) *= 0.7F;
  }
  return depth;
}

sensor_msgs::Image message(const OwnedDepth<std::uint16_t>& depth) {
  sensor_msgs::Image image;
  image.encoding = "16UC1";
  image.width = static_cast<std::uint32_t>(depth.width);
  image.height = static_cast<std::uint32_t>(depth.height);
  image.step = 2 * image.width;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(depth.pixels.data());
  image.data.assign(bytes, bytes + image.step * image.height);
  return image;
}

sensor_msgs::CameraInfo cameraInfo() {
  const CameraModel camera = testCamera();
  sensor_msgs::CameraInfo info;
  info.width = 640;
  info.height = 480;
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

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

TEST_F(Nodelet, SubscribesWithTheFirstListenerAndUnsubscribesWithTheLast) {
  ASSERT_TRUE(ros::service::waitForService("/plane_detection/set_parameters", 20000));
  EXPECT_EQ(images_.getNumSubscribers(), 0U);
  {
    Listener<sensor_msgs::Image> mask(node_, "/plane_detection/ground_mask");
    EXPECT_TRUE(waitForSubscription());
    Listener<DominantPlane> planes(node_, "/plane_detection/plane");
    EXPECT_TRUE(spinUntil([&] { return planes.connected(); }));
  }
  EXPECT_TRUE(spinUntil(
      [&] { return images_.getNumSubscribers() == 0 && infos_.getNumSubscribers() == 0; }));
}

TEST_F(Nodelet, AllOutputsOfOneImage) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  Listener<pcl_msgs::ModelCoefficients> coefficients(node_, "/plane_detection/coefficients");
  Listener<sensor_msgs::Image> masks(node_, "/plane_detection/ground_mask");
  Listener<sensor_msgs::Image> overlays(node_, "/plane_detection/overlay");
  Listener<pcl::PointCloud<pcl::PointXYZ>> obstacles(node_, "/plane_detection/obstacles");
  Listener<pcl::PointCloud<pcl::PointXYZ>> grounds(node_, "/plane_detection/ground");
  ASSERT_TRUE(waitForSubscription());
  ASSERT_TRUE(spinUntil([&] {
    return planes.connected() && coefficients.connected() && masks.connected() &&
           overlays.connected() && obstacles.connected() && grounds.connected();
  }));
  const DominantPlaneConstPtr plane = detect(planes, image_);
  expectTruth(plane);
  ASSERT_TRUE(spinUntil([&] {
    return coefficients.size() > 0 && masks.size() > 0 && overlays.size() > 0 &&
           obstacles.size() > 0 && grounds.size() > 0;
  }));
  EXPECT_EQ(coefficients.last()->header.stamp, plane->header.stamp);
  EXPECT_NEAR(static_cast<double>(coefficients.last()->values.at(3)), plane->distance, 1e-6);

  const sensor_msgs::Image& mask = *masks.last();
  EXPECT_EQ(mask.encoding, "mono8");
  EXPECT_EQ(mask.data[230 * 640 + 330], 0);
  EXPECT_EQ(mask.data[400 * 640 + 330], 255);
  const sensor_msgs::Image& overlay = *overlays.last();
  EXPECT_EQ(overlay.encoding, "bgr8");
  EXPECT_EQ(overlay.data[400 * overlay.step + 3 * 330], 0);

  // Points that pcl_ros hands to a typed subscriber, against mask and truth.
  EXPECT_EQ(grounds.last()->size(), plane->inliers);
  EXPECT_EQ(pcl_conversions::fromPCL(grounds.last()->header).stamp, plane->header.stamp);
  EXPECT_EQ(grounds.last()->header.frame_id, "optical");
  for (const auto& point : *grounds.last()) {
    ASSERT_NEAR(kUp.dot(point.getVector3fMap().cast<double>()) + kHeight, 0.0, 0.05);
  }
  EXPECT_NEAR(static_cast<double>(obstacles.last()->size()), 3600.0, 10.0);
  for (const auto& point : *obstacles.last()) {
    ASSERT_NEAR(kUp.dot(point.getVector3fMap().cast<double>()) + kHeight, kBox, 0.01);
  }
}

TEST_F(Nodelet, OverlayTakesThePictureThatComesLater) {
  const ros::Publisher pictures = node_.advertise<sensor_msgs::Image>("/image", 5);
  Listener<sensor_msgs::Image> overlays(node_, "/plane_detection/overlay");
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  ASSERT_TRUE(spinUntil([&] {
    return pictures.getNumSubscribers() > 0 && overlays.connected() && planes.connected();
  }));
  sensor_msgs::Image picture;
  picture.encoding = "rgb8";
  picture.width = 640;
  picture.height = 480;
  picture.step = 3 * picture.width;
  picture.data.assign(picture.step * picture.height, 0);
  for (std::size_t i = 0; i < picture.data.size(); i += 3) picture.data[i + 2] = 240;  // blue

  picture.header.stamp = send(image_);
  pictures.publish(picture);
  ASSERT_TRUE(spinUntil([&] { return overlays.size() == 1; }));
  EXPECT_EQ(overlays.last()->header.stamp, picture.header.stamp);
  const auto pixel = [&](int u, int v, std::uint32_t channel) {
    return static_cast<int>(
        overlays.last()->data[static_cast<std::size_t>(v) * overlays.last()->step +
                              3 * static_cast<std::size_t>(u) + channel]);
  };
  EXPECT_EQ(pixel(330, 400, 0), 0);    // ground: black
  EXPECT_EQ(pixel(330, 230, 0), 180);  // box: two thirds of the picture's blue, a third of the tint
  EXPECT_EQ(pixel(330, 230, 2), 85);

  // Two images without a picture: the first is not held back when the second comes.
  const auto first = detect(planes, image_);
  ASSERT_TRUE(first);
  send(image_);
  ASSERT_TRUE(spinUntil([&] { return overlays.size() == 2; }));
  EXPECT_EQ(overlays.last()->header.stamp, first->header.stamp);
  EXPECT_EQ(pixel(330, 230, 0), pixel(330, 230, 1));  // grey, tinted red
}

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

TEST_F(Nodelet, OrganisedCloudsGiveTheSamePlane) {
  const ros::Publisher clouds = node_.advertise<pcl::PointCloud<pcl::PointXYZ>>("/points", 1);
  Listener<DominantPlane> planes(node_, "/points_detection/plane");
  ASSERT_TRUE(spinUntil([&] { return clouds.getNumSubscribers() > 0 && planes.connected(); }));
  const OwnedDepth<float> depth = sceneMetres();
  RayTable rays;
  rays.build(testCamera());
  auto cloud = boost::make_shared<pcl::PointCloud<pcl::PointXYZ>>(640, 480);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const Eigen::Vector3f point = metresAt(depth.view(), u, v) * rays.ray(u, v);
      cloud->at(u, v) = {point.x(), point.y(), point.z()};
    }
  }
  cloud->header.frame_id = "optical";
  const ros::Time stamp = nextStamp();
  pcl_conversions::toPCL(stamp, cloud->header.stamp);
  clouds.publish(cloud);
  ASSERT_TRUE(spinUntil([&] { return planes.size() > 0; }));
  EXPECT_EQ(planes.last()->header.stamp, stamp);
  expectTruth(planes.last());
}

class Reconfigure : public Nodelet {
 protected:
  /// @return the configuration that the node has afterwards.
  dynamic_reconfigure::Config set(const std::string& name, double value) {
    dynamic_reconfigure::ReconfigureRequest request;
    dynamic_reconfigure::ReconfigureResponse response;
    dynamic_reconfigure::DoubleParameter parameter;
    parameter.name = name;
    parameter.value = value;
    request.config.doubles.push_back(parameter);
    EXPECT_TRUE(ros::service::call("/plane_detection/set_parameters", request, response));
    return response.config;
  }
  static double valueOf(const dynamic_reconfigure::Config& config, const std::string& name) {
    for (const auto& parameter : config.doubles) {
      if (parameter.name == name) return parameter.value;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }
};

TEST_F(Reconfigure, StartsFromTheParameterServerWithoutWhatWasWrong) {
  ASSERT_TRUE(ros::service::waitForService("/plane_detection/set_parameters", 20000));
  double range_max = 0.0;
  int seeds = 0;
  std::string algorithm;
  ASSERT_TRUE(node_.getParam("/plane_detection/range_max", range_max));
  ASSERT_TRUE(node_.getParam("/plane_detection/seeds", seeds));
  ASSERT_TRUE(node_.getParam("/plane_detection/algorithm", algorithm));
  EXPECT_EQ(range_max, 3.9);
  EXPECT_EQ(seeds, Parameters().seeds);
  EXPECT_EQ(algorithm, "grid");
}

TEST_F(Reconfigure, TakesEffectAndRefusesCombinationsThatCannotBe) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  const auto far = detect(planes, image_);
  expectTruth(far);
  EXPECT_EQ(valueOf(set("range_max", 1.4), "range_max"), 1.4);
  const auto near = detect(planes, image_);
  expectTruth(near);
  EXPECT_LT(near->inliers, far->inliers * 3 / 4);
  // Beyond range_max: refused, and the old values go back to whoever asked.
  EXPECT_EQ(valueOf(set("range_min", 2.0), "range_min"), 0.5);
  EXPECT_EQ(detect(planes, image_)->inliers, near->inliers);
  EXPECT_EQ(valueOf(set("range_max", 3.9), "range_max"), 3.9);
  EXPECT_EQ(detect(planes, image_)->inliers, far->inliers);
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "nodelet_rostest");
  ros::NodeHandle node;  // keeps ROS up between the tests
  return RUN_ALL_TESTS();
}
