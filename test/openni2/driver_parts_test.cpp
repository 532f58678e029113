// The parts of the driver nodelet that need no camera.

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <cstring>
#include <vector>

#include "ros/camera_calibration.h"
#include "ros/depth_corrector.h"
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
  EXPECT_FALSE(scaled(sensor_msgs::CameraInfo(), 640, 480)) << "no size";
  EXPECT_FALSE(scaled(info, 0, 480)) << "no size";
}

/// 640 x 480 of a sensor of 1280 x 1024: half the size, and 16 rows cut off above and below.
TEST(CameraCalibrationTest, AnotherShapeIsCutOffAboveAndBelow) {
  sensor_msgs::CameraInfo info = pinhole(1280, 1024, 1.0);
  info.K[2] = info.P[2] = 650.0;
  info.K[5] = info.P[6] = 500.0;
  const auto small = scaled(info, 640, 480);
  ASSERT_TRUE(small);
  EXPECT_DOUBLE_EQ(small->K[0], 0.5 * info.K[0]);
  EXPECT_DOUBLE_EQ(small->K[4], 0.5 * info.K[4]);
  EXPECT_TRUE(rayOf(*small, -0.5, -0.5).isApprox(rayOf(info, -0.5, 31.5), 1e-12));
  EXPECT_TRUE(rayOf(*small, 639.5, 479.5).isApprox(rayOf(info, 1279.5, 991.5), 1e-12));
  EXPECT_DOUBLE_EQ(small->P[2], small->K[2]);
  EXPECT_DOUBLE_EQ(small->P[6], small->K[5]);
  // And back.
  const auto large = scaled(*small, 1280, 1024);
  ASSERT_TRUE(large);
  EXPECT_DOUBLE_EQ(large->K[5], 500.0);
}

TEST(CameraCalibrationTest, ShiftedMovesThePrincipalPoints) {
  const sensor_msgs::CameraInfo info = pinhole(640, 480, 1.0);
  const sensor_msgs::CameraInfo moved = shifted(info, -5.0, -4.0);
  EXPECT_DOUBLE_EQ(moved.K[2], info.K[2] - 5.0);
  EXPECT_DOUBLE_EQ(moved.P[2], info.P[2] - 5.0);
  EXPECT_DOUBLE_EQ(moved.K[5], info.K[5] - 4.0);
  EXPECT_DOUBLE_EQ(moved.P[6], info.P[6] - 4.0);
  EXPECT_DOUBLE_EQ(moved.K[0], info.K[0]);
}

TEST(CameraCalibrationTest, PinholeHasTheFieldOfView) {
  const sensor_msgs::CameraInfo info = pinhole(640, 480, 1.0145);
  EXPECT_NEAR(info.K[0], 575.8, 0.1);  // what openni_camera users know
  EXPECT_DOUBLE_EQ(info.K[2], 319.5);
  EXPECT_DOUBLE_EQ(info.K[5], 239.5);
  EXPECT_NEAR(std::atan(rayOf(info, 639.5, 0).x()) - std::atan(rayOf(info, -0.5, 0).x()), 1.0145,
              1e-12);
}

class DepthCorrectorTest : public testing::Test {
 protected:
  DepthCorrectorTest() : image_(boost::make_shared<sensor_msgs::Image>()) {
    image_->width = 3;
    image_->height = 2;
    image_->step = 8;  // two bytes of padding
    image_->encoding = "16UC1";
    const std::uint16_t pixels[] = {0, 1000, 2000, 7, 65000, 4, 10, 7};
    image_->data.resize(sizeof(pixels));
    std::memcpy(image_->data.data(), pixels, sizeof(pixels));
    original_ = image_->data;
  }
  static std::uint16_t pixel(const sensor_msgs::ImagePtr& image, std::size_t u, std::size_t v) {
    std::uint16_t value = 0;
    std::memcpy(&value, &image->data[v * image->step + 2 * u], sizeof(value));
    return value;
  }
  void expect(const sensor_msgs::ImagePtr& corrected, const std::vector<int>& expected) const {
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(pixel(corrected, i % 3, i / 3), expected[i]) << i;
    }
    EXPECT_EQ(corrected->width, 3U);
    EXPECT_EQ(corrected->height, 2U);
    EXPECT_EQ(corrected->step, 8U);
    EXPECT_EQ(corrected->encoding, "16UC1");
    EXPECT_NE(corrected, image_);
    EXPECT_EQ(image_->data, original_) << "it may be somebody else's, too";
  }

  sensor_msgs::ImagePtr image_;
  std::vector<std::uint8_t> original_;
};

TEST_F(DepthCorrectorTest, ScalesAndShiftsReadingsOnly) {
  DepthCorrector corrector;
  corrector.set(-0.005, 1.01);
  expect(corrector.correct(image_, false), {0, 1005, 2015, 0, 0, 5});
}

TEST_F(DepthCorrectorTest, WithoutACorrectionNothingIsCopied) {
  DepthCorrector corrector;
  EXPECT_EQ(corrector.correct(image_, false), image_);
  corrector.set(0.001, 1.0);
  EXPECT_NE(corrector.correct(image_, false), image_);
  corrector.set(0.0, 1.0);
  EXPECT_EQ(corrector.correct(image_, false), image_);
}

/// 1 / z' = 1 / z - 0.01 / m, with and without a scale before it.
TEST_F(DepthCorrectorTest, TakesAwayWhatIsFixedToThePixels) {
  DepthCorrector corrector(DepthCalibration::kinect(), DepthCorrection({1, 1, {0.01}}));
  expect(corrector.correct(image_, false), {0, 1010, 2041, 0, 4, 10});
  corrector.set(0.0, 2.0);
  expect(corrector.correct(image_, false), {0, 2041, 4167, 0, 8, 20});
}

TEST_F(DepthCorrectorTest, RawDisparityBecomesMillimetres) {
  DepthCorrector corrector;
  corrector.set(0.01, 1.1);
  const DisparityTable table(DepthCalibration::kinect(), 0.01, 1.1);
  expect(corrector.correct(image_, true),
         {table[0], table[1000], table[2000], 0, table[4], table[10]});
}

TEST_F(DepthCorrectorTest, ImagesThatAreKeptHaveABound) {
  DepthCorrector corrector;
  corrector.set(0.0, 1.1);
  image_->width = 5000;
  image_->height = 1000;
  image_->step = 10000;
  image_->data.resize(10'000'000);
  std::vector<sensor_msgs::ImagePtr> kept;
  while (kept.size() < 41) kept.push_back(corrector.correct(image_, false));  // 410 MB
  EXPECT_THROW(corrector.correct(image_, false), std::runtime_error);
  kept.pop_back();
  kept.pop_back();
  EXPECT_TRUE(corrector.correct(image_, false));
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
