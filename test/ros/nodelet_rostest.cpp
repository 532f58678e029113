// What the nodelet publishes, and when it subscribes; on a scene whose truth is known.

#include <dominant_plane_detection/DominantPlaneArray.h>
#include <pcl_conversions/pcl_conversions.h>
#include <pcl_msgs/ModelCoefficients.h>
#include <pcl_msgs/PointIndices.h>
#include <pcl_ros/point_cloud.h>
#include <rosgraph_msgs/Log.h>

#include <algorithm>
#include <cmath>

#include "nodelet_fixture.h"

namespace dominant_plane_detection {
namespace {

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
  Listener<sensor_msgs::Image> labels(node_, "/plane_detection/labels");
  Listener<sensor_msgs::Image> overlays(node_, "/plane_detection/overlay");
  Listener<pcl::PointCloud<pcl::PointXYZ>> obstacles(node_, "/plane_detection/obstacles");
  Listener<pcl::PointCloud<pcl::PointXYZ>> grounds(node_, "/plane_detection/ground");
  ASSERT_TRUE(waitForSubscription());
  ASSERT_TRUE(spinUntil([&] {
    return planes.connected() && coefficients.connected() && masks.connected() &&
           labels.connected() && overlays.connected() && obstacles.connected() &&
           grounds.connected();
  }));
  const DominantPlaneConstPtr plane = detect(planes, image_);
  expectTruth(plane);
  ASSERT_TRUE(spinUntil([&] {
    return coefficients.size() > 0 && masks.size() > 0 && labels.size() > 0 &&
           overlays.size() > 0 && obstacles.size() > 0 && grounds.size() > 0;
  }));
  EXPECT_EQ(coefficients.last()->header.stamp, plane->header.stamp);
  EXPECT_NEAR(static_cast<double>(coefficients.last()->values.at(3)), plane->distance, 1e-6);

  const sensor_msgs::Image& mask = *masks.last();
  EXPECT_EQ(mask.encoding, "mono8");
  EXPECT_EQ(mask.data[230 * 640 + 330], 0);
  EXPECT_EQ(mask.data[400 * 640 + 330], 255);
  EXPECT_EQ(labels.last()->header.stamp, plane->header.stamp);
  EXPECT_EQ(labels.last()->encoding, "mono8");
  EXPECT_EQ(labels.last()->step, 640U);
  EXPECT_EQ(labels.last()->data[230 * 640 + 330], 2);
  EXPECT_EQ(labels.last()->data[400 * 640 + 330], 1);
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

/// A trench of 40 x 60 pixels, 10 cm deep as seen along the rays.
TEST_F(Nodelet, DropOffsAreACloud) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  Listener<pcl::PointCloud<pcl::PointXYZ>> drop_offs(node_, "/plane_detection/drop_offs");
  ASSERT_TRUE(waitForSubscription());
  ASSERT_TRUE(spinUntil([&] { return planes.connected() && drop_offs.connected(); }));
  sensor_msgs::Image image = image_;
  auto* pixels = reinterpret_cast<std::uint16_t*>(image.data.data());
  for (int v = 400; v < 440; ++v) {
    for (int u = 100; u < 160; ++u) {
      std::uint16_t& z = pixels[v * 640 + u];
      z = static_cast<std::uint16_t>(std::lround(z * (kHeight + 0.1) / kHeight));
    }
  }
  expectTruth(detect(planes, image));
  ASSERT_TRUE(spinUntil([&] { return drop_offs.size() > 0; }));
  EXPECT_EQ(drop_offs.last()->size(), 2400U);
  for (const auto& point : *drop_offs.last()) {
    ASSERT_NEAR(kUp.dot(point.getVector3fMap().cast<double>()) + kHeight, -0.1, 0.005);
  }
}

/// A hole of 80 x 60 pixels without readings: its cloud is on the plane.
TEST_F(Nodelet, MissingGroundIsACloudOnThePlane) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  Listener<pcl::PointCloud<pcl::PointXYZ>> missing(node_, "/plane_detection/missing_ground");
  ASSERT_TRUE(waitForSubscription());
  ASSERT_TRUE(spinUntil([&] { return planes.connected() && missing.connected(); }));
  sensor_msgs::Image image = image_;
  auto* pixels = reinterpret_cast<std::uint16_t*>(image.data.data());
  for (int v = 400; v < 460; ++v) std::fill_n(pixels + v * 640 + 100, 80, std::uint16_t{0});
  expectTruth(detect(planes, image));
  ASSERT_TRUE(spinUntil([&] { return missing.size() > 0; }));
  EXPECT_EQ(missing.last()->size(), 4800U);
  for (const auto& point : *missing.last()) {
    ASSERT_NEAR(kUp.dot(point.getVector3fMap().cast<double>()) + kHeight, 0.0, 0.002);
    ASSERT_GT(point.z, 0.3F);
  }
}

/// What else is made of one image, each while somebody listens to it alone.
TEST_F(Nodelet, PlanesHeightsAndIndices) {
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  Listener<DominantPlaneArray> all(node_, "/plane_detection/planes");
  Listener<sensor_msgs::Image> index(node_, "/plane_detection/plane_index");
  Listener<sensor_msgs::Image> heights(node_, "/plane_detection/height_image");
  Listener<pcl_msgs::PointIndices> obstacles(node_, "/plane_detection/obstacle_indices");
  ASSERT_TRUE(waitForSubscription());
  ASSERT_TRUE(spinUntil([&] {
    return planes.connected() && all.connected() && index.connected() && heights.connected() &&
           obstacles.connected();
  }));
  const DominantPlaneConstPtr plane = detect(planes, image_);
  expectTruth(plane);
  ASSERT_TRUE(spinUntil([&] {
    return all.size() > 0 && index.size() > 0 && heights.size() > 0 && obstacles.size() > 0;
  }));
  ASSERT_EQ(all.last()->planes.size(), 1U);
  EXPECT_EQ(all.last()->planes[0].distance, plane->distance);
  EXPECT_GT(plane->covariance[15], 0.0);
  EXPECT_EQ(std::count(index.last()->data.begin(), index.last()->data.end(), 1),
            static_cast<std::ptrdiff_t>(plane->inliers));
  EXPECT_EQ(heights.last()->header.stamp, plane->header.stamp);
  const auto* height = reinterpret_cast<const float*>(heights.last()->data.data());
  EXPECT_NEAR(static_cast<double>(height[230 * 640 + 330]), kBox, 0.005);
  EXPECT_NEAR(static_cast<double>(height[400 * 640 + 330]), 0.0, 0.005);
  EXPECT_NEAR(static_cast<double>(obstacles.last()->indices.size()), 3600.0, 10.0);
}

sensor_msgs::Image bluePicture() {
  sensor_msgs::Image picture;
  picture.encoding = "rgb8";
  picture.width = 640;
  picture.height = 480;
  picture.step = 3 * picture.width;
  picture.data.assign(picture.step * picture.height, 0);
  for (std::size_t i = 0; i < picture.data.size(); i += 3) picture.data[i + 2] = 240;
  return picture;
}

TEST_F(Nodelet, OverlayTakesThePictureThatComesLater) {
  const ros::Publisher pictures = node_.advertise<sensor_msgs::Image>("/image", 5);
  Listener<sensor_msgs::Image> overlays(node_, "/plane_detection/overlay");
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  ASSERT_TRUE(spinUntil([&] {
    return pictures.getNumSubscribers() > 0 && overlays.connected() && planes.connected();
  }));
  sensor_msgs::Image picture = bluePicture();
  picture.header.frame_id = "optical";
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

TEST_F(Nodelet, PicturesAreSubscribedWhileSomebodyListensToTheOverlay) {
  const ros::Publisher pictures = node_.advertise<sensor_msgs::Image>("/image", 5);
  Listener<DominantPlane> planes(node_, "/plane_detection/plane");
  ASSERT_TRUE(waitForSubscription());
  for (int i = 0; i < 3; ++i) expectTruth(detect(planes, image_));
  EXPECT_EQ(pictures.getNumSubscribers(), 0U);
  {
    Listener<sensor_msgs::Image> overlays(node_, "/plane_detection/overlay");
    EXPECT_TRUE(spinUntil([&] { return pictures.getNumSubscribers() == 1; }));
  }
  EXPECT_TRUE(spinUntil([&] { return pictures.getNumSubscribers() == 0; }));
}

/// Depth that is not registered has another frame than the picture: pixels of the one are not those
/// of the other.
TEST_F(Nodelet, PicturesOfAnotherFrameAreNotPaintedOver) {
  const ros::Publisher pictures = node_.advertise<sensor_msgs::Image>("/image", 5);
  Listener<rosgraph_msgs::Log> log(node_, "/rosout");
  const auto complaints = [&] {
    return std::count_if(log.messages().begin(), log.messages().end(), [](const auto& line) {
      return line->msg.find("expected some in the depth's frame optical") != std::string::npos &&
             line->msg.find("got some in rgb_optical on /image") != std::string::npos;
    });
  };
  Listener<sensor_msgs::Image> overlays(node_, "/plane_detection/overlay");
  ASSERT_TRUE(waitForSubscription());
  ASSERT_TRUE(spinUntil(
      [&] { return pictures.getNumSubscribers() > 0 && overlays.connected() && log.connected(); }));
  sensor_msgs::Image picture = bluePicture();
  picture.header.frame_id = "rgb_optical";
  picture.header.stamp = send(image_);
  pictures.publish(picture);
  ASSERT_TRUE(spinUntil([&] { return overlays.size() == 1; }));
  const auto blue = [&] { return overlays.last()->data[230 * overlays.last()->step + 3 * 330]; };
  const auto green = [&] { return overlays.last()->data[230 * overlays.last()->step + 991]; };
  EXPECT_EQ(blue(), green()) << "grey, tinted red";
  EXPECT_TRUE(spinUntil([&] { return complaints() == 1; }));
  // They are of no use, and their camera may have better to do.
  EXPECT_TRUE(spinUntil([&] { return pictures.getNumSubscribers() == 0; }));
  for (std::size_t i = 2; i <= 4; ++i) {
    send(image_);
    ASSERT_TRUE(spinUntil([&] { return overlays.size() == i; }));
    EXPECT_EQ(blue(), green());
  }
  EXPECT_EQ(complaints(), 1);
}

}  // namespace
}  // namespace dominant_plane_detection
