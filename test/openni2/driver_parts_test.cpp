// The parts of the driver nodelet that need no camera.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "ros/camera_calibration.h"
#include "ros/depth_correction.h"
#include "ros/driver_parameters.h"

namespace dominant_plane_detection {
namespace {

/// A pixel's ray by a camera_info's K and its point in the picture by P.
Eigen::Vector2d rayOf(const sensor_msgs::CameraInfo& info, double u, double v) {
  return {(u - info.K[2]) / info.K[0], (v - info.K[5]) / info.K[4]};
}

TEST(CameraCalibrationTest, ScalingKeepsTheRaysOfTheImagesEdges) {
  sensor_msgs::CameraInfo info = pinhole(640, 480, 1.0);
  info.K[2] = info.P[2] = 310.0;
  info.K[5] = info.P[6] = 250.0;
  info.K[4] = info.P[5] = 500.0;
  info.P[3] = -12.0;
  info.D = {0.1, -0.2, 0.001, 0.002, 0.0};
  for (const double factor : {0.25, 0.5, 2.0}) {
    const auto width = static_cast<std::uint32_t>(640 * factor);
    const auto height = static_cast<std::uint32_t>(480 * factor);
    const auto small = scaled(info, width, height);
    ASSERT_TRUE(small);
    EXPECT_EQ(small->width, width);
    EXPECT_EQ(small->height, height);
    EXPECT_EQ(small->D, info.D);
    EXPECT_TRUE(rayOf(*small, -0.5, -0.5).isApprox(rayOf(info, -0.5, -0.5), 1e-12));
    EXPECT_TRUE(
        rayOf(*small, width - 0.5, height - 0.5).isApprox(rayOf(info, 639.5, 479.5), 1e-12));
    EXPECT_DOUBLE_EQ(small->P[0], small->K[0]);
    EXPECT_DOUBLE_EQ(small->P[2], small->K[2]);
    EXPECT_DOUBLE_EQ(small->P[5], small->K[4]);
    EXPECT_DOUBLE_EQ(small->P[6], small->K[5]);
    EXPECT_DOUBLE_EQ(small->P[3], -12.0 * factor);
  }
  EXPECT_FALSE(scaled(info, 640, 512)) << "another shape";
  EXPECT_FALSE(scaled(sensor_msgs::CameraInfo(), 640, 480)) << "no size";
}

TEST(CameraCalibrationTest, PinholeHasTheFieldOfView) {
  const sensor_msgs::CameraInfo info = pinhole(640, 480, 1.0145);
  EXPECT_NEAR(info.K[0], 575.8, 0.1);  // what openni_camera users know
  EXPECT_DOUBLE_EQ(info.K[2], 319.5);
  EXPECT_DOUBLE_EQ(info.K[5], 239.5);
  EXPECT_NEAR(std::atan(rayOf(info, 639.5, 0).x()) - std::atan(rayOf(info, -0.5, 0).x()), 1.0145,
              1e-12);
}

TEST(DepthCorrection, ScalesAndShiftsReadingsOnly) {
  sensor_msgs::Image image;
  image.width = 3;
  image.height = 2;
  image.step = 8;  // two bytes of padding
  const std::uint16_t pixels[] = {0, 1000, 2000, 7, 65000, 4, 10, 7};
  image.data.resize(sizeof(pixels));
  std::memcpy(image.data.data(), pixels, sizeof(pixels));
  correctDepth(-0.005, 1.01, image);
  std::uint16_t corrected[8];
  std::memcpy(corrected, image.data.data(), sizeof(corrected));
  const std::uint16_t expected[] = {0, 1005, 2015, 7, 0, 0, 5, 7};
  EXPECT_TRUE(std::equal(std::begin(corrected), std::end(corrected), std::begin(expected)));
}

TEST(DriverParametersTest, RefusesWhatIsNone) {
  DriverParameters parameters;
  setParameter(parameters, "depth_mode", "320x240@60");
  EXPECT_EQ(parameters.camera.depth_mode, (VideoMode{320, 240, 60}));
  setParameter(parameters, "depth_registration", "true");
  EXPECT_TRUE(parameters.camera.depth_registration);
  EXPECT_TRUE(findErrors(parameters).empty());
  EXPECT_THROW(setParameter(parameters, "depth_mode", "VGA"), std::invalid_argument);
  EXPECT_THROW(setParameter(parameters, "repeat", "maybe"), std::invalid_argument);
  EXPECT_THROW(setParameter(parameters, "no_such", "1"), std::invalid_argument);
  parameters.z_scale = 0.0;
  EXPECT_EQ(findErrors(parameters).size(), 1U);
}

}  // namespace
}  // namespace dominant_plane_detection
