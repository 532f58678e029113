#include "dominant_plane_detection/depth_image.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {
namespace {

TEST(DepthView, OfMillimetresWithAndWithoutGaps) {
  const std::array<std::uint16_t, 6> pixels{1000, 2000, 3000, 4000, 5000, 6000};
  const DepthView dense(pixels.data(), 3, 2);
  EXPECT_EQ(dense.step, 6U);
  EXPECT_EQ(dense.type, DepthView::Type::kUint16);
  EXPECT_EQ(dense.metres_per_unit, 0.001F);
  EXPECT_EQ(dense.row<std::uint16_t>(1)[2], 6000);
  EXPECT_FLOAT_EQ(metresAt(dense, 1, 1), 5.0F);
  const DepthView spaced(pixels.data(), 1, 3, 0.0002F, 4);
  EXPECT_EQ(spaced.step, 4U);
  EXPECT_FLOAT_EQ(metresAt(spaced, 0, 2), 1.0F);
  EXPECT_EQ(metresPerUnit(spaced), 0.0002F);
  EXPECT_EQ(pixelSize(DepthView::Type::kUint16), 2U);
}

TEST(DepthView, OfMetres) {
  const std::array<float, 6> pixels{1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F};
  const DepthView dense(pixels.data(), 3, 2);
  EXPECT_EQ(dense.step, 12U);
  EXPECT_EQ(dense.type, DepthView::Type::kFloat32);
  EXPECT_EQ(metresAt(dense, 2, 1), 6.0F);
  EXPECT_EQ(metresPerUnit(dense), 1.0F);
  EXPECT_EQ(metresAt(DepthView(pixels.data(), 1, 2, 16), 0, 1), 5.0F);
  EXPECT_EQ(pixelSize(DepthView::Type::kFloat32), 4U);
  EXPECT_EQ(DepthView(pixels.data(), 0, 2).step, 0U);
}

TEST(DepthView, OfNothing) {
  const DepthView view;
  EXPECT_EQ(view.data, nullptr);
  EXPECT_EQ(view.width + view.height, 0);
  EXPECT_EQ(view.step, 0U);
  EXPECT_EQ(view.metres_per_unit, 0.001F);
}

TEST(Detection, SaysNothingAtFirst) {
  const Detection detection;
  EXPECT_FALSE(detection.found());
  EXPECT_TRUE(std::isnan(detection.distance) && std::isnan(detection.mean_square_error));
  EXPECT_TRUE(std::isnan(detection.inlierShare()) && std::isnan(detection.height({1.0, 2.0, 3.0})));
  EXPECT_EQ(detection.inliers + detection.valid_pixels, 0U);
  EXPECT_EQ(detection.image_width + detection.image_height, 0);
  EXPECT_EQ(detection.covariance(0, 0), -1.0);
  EXPECT_EQ(detection.covariance.cwiseAbs().sum(), 1.0);
  EXPECT_EQ(detection.up_source, UpSource::kNone);
  const Effort& e = detection.effort;
  EXPECT_EQ(e.seeds + e.regions + e.tests + e.joined + e.fits + e.searches, 0U);
}

TEST(NoiseModel, AndThresholds) {
  EXPECT_EQ(NoiseModel().sigma(0.0), 0.002);
  EXPECT_DOUBLE_EQ(NoiseModel().sigma(2.0), 0.002 + 4.0 * 1.425e-3);
  EXPECT_EQ(DepthThreshold().at(2.0, NoiseModel()), 0.0);
  EXPECT_DOUBLE_EQ((DepthThreshold{0.01, 3.0}).at(2.0, NoiseModel{0.001, 0.002}), 0.01 + 0.027);
}

}  // namespace
}  // namespace dominant_plane_detection
