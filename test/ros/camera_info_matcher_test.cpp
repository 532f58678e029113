#include "ros/camera_info_matcher.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

namespace dominant_plane_detection {
namespace {

sensor_msgs::ImageConstPtr image(double stamp, const std::string& frame = "camera") {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header.stamp = ros::Time(stamp);
  message->header.frame_id = frame;
  message->width = 640;
  message->height = 480;
  return message;
}

sensor_msgs::CameraInfoConstPtr info(double stamp, const std::string& frame = "camera",
                                     std::uint32_t width = 640) {
  auto message = boost::make_shared<sensor_msgs::CameraInfo>();
  message->header.stamp = ros::Time(stamp);
  message->header.frame_id = frame;
  message->width = width;
  message->height = 480;
  return message;
}

TEST(CameraInfoMatcher, PairsWhicheverComesFirst) {
  CameraInfoMatcher matcher;
  EXPECT_FALSE(matcher.addImage(image(1.0), 0.0));
  const auto first = matcher.addInfo(info(1.0), 0.01);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->exact);
  EXPECT_EQ(first->image->header.stamp, first->info->header.stamp);
  EXPECT_FALSE(matcher.addInfo(info(1.033), 0.03));
  ASSERT_TRUE(matcher.addImage(image(1.033), 0.031));
}

TEST(CameraInfoMatcher, LosesNoImageWhenOneTopicRunsAhead) {
  CameraInfoMatcher matcher;
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(matcher.addImage(image(1.0 + i), 0.01 * i));
  for (int i = 0; i < 5; ++i) {
    const auto pair = matcher.addInfo(info(1.0 + i), 0.1 + 0.01 * i);
    ASSERT_TRUE(pair);
    EXPECT_EQ(pair->image->header.stamp, ros::Time(1.0 + i));
  }
}

TEST(CameraInfoMatcher, AfterASecondTheLatestOfTheSameFrameAndSizeDoes) {
  CameraInfoMatcher matcher;
  EXPECT_FALSE(matcher.addInfo(info(50.0), 0.0));
  EXPECT_FALSE(matcher.addInfo(info(51.0, "another"), 0.0));
  EXPECT_FALSE(matcher.addInfo(info(52.0, "camera", 320), 0.0));
  EXPECT_FALSE(matcher.addImage(image(1.0), 0.0));
  EXPECT_FALSE(matcher.addImage(image(1.9), 0.9));
  const auto pair = matcher.addImage(image(2.1), 1.1);
  ASSERT_TRUE(pair);
  EXPECT_FALSE(pair->exact);
  EXPECT_EQ(pair->info->header.stamp, ros::Time(50.0));
  EXPECT_FALSE(matcher.addImage(image(2.2, "unknown"), 1.2));
  // Equal stamps are preferred again as soon as they come.
  EXPECT_FALSE(matcher.addInfo(info(2.3), 1.3));
  const auto exact = matcher.addImage(image(2.3), 1.3);
  ASSERT_TRUE(exact);
  EXPECT_TRUE(exact->exact);
  EXPECT_FALSE(matcher.addImage(image(2.4), 1.4));
}

/// The size that counts is that of the images, not that of the sensor.
TEST(CameraInfoMatcher, SizesAreThoseOfRegionAndBinning) {
  const auto cropped = boost::make_shared<sensor_msgs::CameraInfo>(*info(50.0));
  cropped->width = 1280;
  cropped->height = 1024;
  cropped->roi.width = 1280;
  cropped->roi.height = 960;
  cropped->binning_x = cropped->binning_y = 2;
  CameraInfoMatcher matcher;
  EXPECT_FALSE(matcher.addInfo(cropped, 0.0));
  EXPECT_FALSE(matcher.addImage(image(1.0), 0.0));
  EXPECT_TRUE(matcher.addImage(image(2.1), 1.1));
}

TEST(CameraInfoMatcher, WithoutAnyCameraInfoThereIsNoPair) {
  CameraInfoMatcher matcher;
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(matcher.addImage(image(i), i));
}

}  // namespace
}  // namespace dominant_plane_detection
