#include "dominant_plane_detection/depth_calibration.h"

#include <gtest/gtest.h>

#include <utility>

namespace dominant_plane_detection {
namespace {

TEST(DepthCalibration, PaperConstantsGiveTheValuesOfEquation1) {
  const DepthCalibration paper = DepthCalibration::paper();
  const std::pair<int, double> expected_mm[] = {{25, 3.4},     {50, 407.0},    {100, 753.0},
                                                {500, 1060.0}, {1000, 1323.0}, {2047, 2106.0}};
  for (const auto& [raw, mm] : expected_mm) EXPECT_NEAR(1000.0 * paper.evaluate(raw), mm, 0.6);
  EXPECT_LT(paper.evaluate(24), 0.0);
}

TEST(DepthCalibration, KinectDistances) {
  const DepthCalibration kinect = DepthCalibration::kinect();
  EXPECT_NEAR(kinect.distance(500), 0.557, 5e-4);
  EXPECT_NEAR(kinect.distance(800), 1.144, 5e-4);
  EXPECT_NEAR(kinect.distance(1000), 3.848, 5e-4);
}

TEST(DepthCalibration, NoReadingWhereThereIsNoDistance) {
  EXPECT_EQ(DepthCalibration::kinect().distance(2047), 0.0);
  EXPECT_EQ(DepthCalibration::kinect().distance(1085), 0.0);  // negative
  EXPECT_EQ(DepthCalibration::kinect().distance(-1), 0.0);
  EXPECT_EQ(DepthCalibration::paper().distance(10), 0.0);  // negative
  EXPECT_EQ(DepthCalibration::paper().distance(2047), 0.0);
  EXPECT_EQ(DepthCalibration().distance(500), 0.0);  // 1 / 0
}

}  // namespace
}  // namespace dominant_plane_detection
