#include "dominant_plane_detection/depth_calibration.h"

#include <gtest/gtest.h>

#include <utility>

#include "core/disparity_table.h"

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

TEST(DepthCalibration, HasNoConstantsByItself) {
  const DepthCalibration none;
  EXPECT_EQ(none.form, DepthCalibration::Form::kReciprocal);
  for (const double constant : {none.a, none.b, none.c, none.d}) EXPECT_EQ(constant, 0.0);
}

TEST(DisparityTable, GivesEachReadingItsMillimetres) {
  const DisparityTable table(DepthCalibration::kinect(), 0.01, 1.1);
  const std::uint16_t raw[] = {500, 2047, 1000, 0, 60000, 800};
  std::uint16_t millimetres[] = {1, 2, 3, 4, 5, 6};
  table.apply(raw, 5, millimetres);
  EXPECT_NEAR(millimetres[0], 1.1 * 557 + 10, 1.0);
  EXPECT_EQ(millimetres[1], 0);
  EXPECT_NEAR(millimetres[2], 1.1 * 3848 + 10, 1.0);
  EXPECT_NEAR(millimetres[3], 1.1 * 300.2 + 10, 1.0);
  EXPECT_EQ(millimetres[4], 0);
  EXPECT_EQ(millimetres[5], 6) << "beyond the last";
  // In place.
  std::uint16_t pixels[] = {500, 2047};
  table.apply(pixels, 2, pixels);
  EXPECT_EQ(pixels[0], millimetres[0]);
  EXPECT_EQ(pixels[1], 0);
}

}  // namespace
}  // namespace dominant_plane_detection
