// camera.launch with processing:=true: rectified images and clouds of the virtual Kinect.

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <cmath>
#include <cstring>

#include "support/reconfigure.h"
#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

using sensor_msgs::CameraInfo;
using sensor_msgs::Image;
using sensor_msgs::PointCloud2;

constexpr std::uint32_t kWidth = 640, kHeight = 480;

template <typename Value>
Value pixel(const Image& image, std::uint32_t u, std::uint32_t v) {
  Value value;
  std::memcpy(&value, &image.data[v * image.step + u * sizeof(Value)], sizeof(Value));
  return value;
}

/// @return the message of a listener with the stamp of another one; null while there is none.
template <typename Message>
boost::shared_ptr<const Message> at(const Listener<Message>& listener, const ros::Time& stamp) {
  for (const auto& message : listener.messages()) {
    if (message->header.stamp == stamp) return message;
  }
  return nullptr;
}

/// @return the latest message of a listener of whose stamp all others have one, too; null so far.
template <typename Message, typename... Others>
boost::shared_ptr<const Message> together(const Listener<Message>& first, const Others&... others) {
  for (auto one = first.messages().rbegin(); one != first.messages().rend(); ++one) {
    if ((at(others, (*one)->header.stamp) && ...)) return *one;
  }
  return nullptr;
}

/// Every point is where the depth image and the camera's pinhole say.
void expectPoints(const PointCloud2& cloud, const Image& depth, const CameraInfo& info) {
  ASSERT_EQ(cloud.width, kWidth);
  ASSERT_EQ(cloud.height, kHeight);
  EXPECT_EQ(cloud.header.frame_id, depth.header.frame_id);
  sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
  int readings = 0;
  for (std::uint32_t v = 0; v < kHeight; ++v) {
    for (std::uint32_t u = 0; u < kWidth; ++u, ++x, ++y, ++z) {
      const double metres = 0.001 * pixel<std::uint16_t>(depth, u, v);
      if (metres == 0.0) {
        ASSERT_TRUE(std::isnan(*z));
        continue;
      }
      ++readings;
      ASSERT_NEAR(*z, metres, 1e-5);
      ASSERT_NEAR(*x, (u - info.K[2]) * metres / info.K[0], 1e-5);
      ASSERT_NEAR(*y, (v - info.K[5]) * metres / info.K[4], 1e-5);
    }
  }
  EXPECT_GT(readings, 200000);
}

class Processing : public testing::Test {
 protected:
  ros::NodeHandle node_{"/camera"};
};

TEST_F(Processing, DepthIsRectifiedInMetresAndAsPoints) {
  Listener<Image> depth(node_, "depth/image_raw"), rectified(node_, "depth/image_rect_raw"),
      metric(node_, "depth/image_rect");
  Listener<CameraInfo> infos(node_, "depth/camera_info");
  Listener<PointCloud2> clouds(node_, "depth/points");
  Image::ConstPtr image;
  ASSERT_TRUE(spinUntil(
      [&] { return (image = together(depth, rectified, metric, infos, clouds)) != nullptr; },
      40.0));
  const ros::Time stamp = image->header.stamp;
  EXPECT_EQ(image->header.frame_id, "camera_depth_optical_frame");
  expectPoints(*at(clouds, stamp), *image, *at(infos, stamp));
  // The virtual Kinect has no distortion.
  EXPECT_EQ(at(rectified, stamp)->data, image->data);
  const Image& metres = *at(metric, stamp);
  ASSERT_EQ(metres.encoding, "32FC1");
  for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
    const auto millimetres = pixel<std::uint16_t>(*image, i % kWidth, i / kWidth);
    const auto value = pixel<float>(metres, i % kWidth, i / kWidth);
    ASSERT_TRUE(millimetres == 0 ? std::isnan(value) : std::abs(value - 0.001 * millimetres) < 1e-6)
        << millimetres << ' ' << value;
  }
}

TEST_F(Processing, ColourIsRectified) {
  Listener<Image> colour(node_, "rgb/image_raw"), rectified(node_, "rgb/image_rect_color");
  Image::ConstPtr image;
  ASSERT_TRUE(spinUntil([&] { return (image = together(colour, rectified)) != nullptr; }, 40.0));
  const Image& result = *at(rectified, image->header.stamp);
  EXPECT_EQ(result.width, kWidth);
  EXPECT_EQ(result.height, kHeight);
  EXPECT_EQ(result.encoding, "rgb8");
  EXPECT_EQ(result.header.frame_id, "camera_rgb_optical_frame");
  EXPECT_EQ(result.data, image->data);
}

TEST_F(Processing, RegisteredPointsHaveColours) {
  ASSERT_TRUE(change("/camera/driver", "depth_registration", true));
  Listener<Image> depth(node_, "depth_registered/image_raw"), colour(node_, "rgb/image_raw"),
      metric(node_, "depth_registered/image_rect");
  Listener<CameraInfo> infos(node_, "depth_registered/camera_info");
  Listener<PointCloud2> clouds(node_, "depth_registered/points");
  Image::ConstPtr image;
  ASSERT_TRUE(spinUntil(
      [&] { return (image = together(depth, colour, metric, infos, clouds)) != nullptr; }, 40.0));
  const ros::Time stamp = image->header.stamp;
  EXPECT_EQ(image->header.frame_id, "camera_rgb_optical_frame");
  const PointCloud2& cloud = *at(clouds, stamp);
  expectPoints(cloud, *image, *at(infos, stamp));
  sensor_msgs::PointCloud2ConstIterator<std::uint8_t> r(cloud, "r"), g(cloud, "g"), b(cloud, "b");
  const std::vector<std::uint8_t>& pixels = at(colour, stamp)->data;
  for (std::size_t i = 0; i < pixels.size(); i += 3, ++r, ++g, ++b) {
    ASSERT_EQ(*r, pixels[i]);
    ASSERT_EQ(*g, pixels[i + 1]);
    ASSERT_EQ(*b, pixels[i + 2]);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
