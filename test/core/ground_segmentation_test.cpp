#include "core/ground_segmentation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/ray_table.h"
#include "dominant_plane_detection/detection.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

const SegmentationLimits kLimits{NoiseModel{0.002, 1.425e-3}, DepthThreshold{0.0, 3.0}, {}};
constexpr ReadingRange kRange{1.0F, 0.5F, 4.0F};

struct Size {
  int width;
  int height;
};

class LabelledSize : public testing::TestWithParam<Size> {};

/// Every pixel at a height of its own: ground, above, below, out of range or without a reading.
TEST_P(LabelledSize, EveryPixelByItsHeight) {
  const CameraModel camera = testCamera(GetParam().width, GetParam().height);
  const Eigen::Vector3d up = upOf(0.6, -0.2);
  const double height = 1.1;
  OwnedDepth<float> depth = planeDepth(camera, up, height);
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    depth.pixels[i] *= 0.7F + 0.06F * static_cast<float>(i % 11);
    if (i % 13 == 0) depth.pixels[i] = std::numeric_limits<float>::quiet_NaN();
  }
  RayTable rays;
  rays.build(camera);
  GroundSegmentation segmentation;
  std::vector<std::uint8_t> labels;
  const DepthView view = depth.view();
  // The region is every second column of tiles but the first ten: all pixels from the ninth tile on
  // are in it or next to it.
  const int columns = (depth.width + 7) / 8, rows = (depth.height + 7) / 8;
  std::vector<std::uint8_t> region(static_cast<std::size_t>(columns * rows));
  const std::vector<std::uint8_t> nowhere(region.size(), 0);
  for (std::size_t i = 0; i < region.size(); ++i) {
    const int column = static_cast<int>(i) % columns;
    region[i] = columns < 10 || (column >= 10 && column % 2 == 0);
  }
  const SegmentationCounts counts =
      segmentation.label({view, rays, kRange}, up, height, kLimits, {region, nowhere}, labels);
  ASSERT_EQ(labels.size(), depth.pixels.size());
  std::size_t ground = 0;
  double sum_squares = 0.0;
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      const double z = static_cast<double>(depth.at(u, v));
      const double h = z * up.dot(rays.ray(u, v).cast<double>()) + height;
      const double band = kLimits.band.at(z, kLimits.noise);
      Label expected = std::abs(h) <= band ? Label::kGround
                       : h > 0.0           ? Label::kObstacle
                                           : Label::kDropOff;
      // Beyond the range only what is below a plane that is not.
      const double at_farthest = 4.0 * up.dot(rays.ray(u, v).cast<double>()) + height;
      const bool below_farthest = z > 4.0 && h < -2.0 * band && at_farthest <= 0.0;
      if (z > 4.0 && (std::abs(at_farthest) < 1e-5 || std::abs(h + 2.0 * band) < 1e-5)) continue;
      if (!(z >= 0.5 && z <= 4.0) && !below_farthest) expected = Label::kUnknown;
      if (std::abs(std::abs(h) - band) < 1e-5) continue;  // float decides
      if (expected == Label::kGround && columns >= 10 && u < 72) expected = Label::kUnknown;
      const std::size_t i = static_cast<std::size_t>(v * depth.width + u);
      ASSERT_EQ(static_cast<int>(labels[i]), static_cast<int>(expected)) << u << ", " << v;
      if (expected == Label::kGround) {
        ++ground;
        sum_squares += h * h;
      }
    }
  }
  EXPECT_EQ(counts.ground, ground);
  if (ground > 0) {
    EXPECT_NEAR(counts.mean_square_error * static_cast<double>(ground) / sum_squares, 1.0, 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, LabelledSize,
                         testing::Values(Size{640, 480}, Size{321, 239}, Size{1, 1}, Size{15, 9}));

/// One tile in the middle of a floor is the region.
TEST(GroundSegmentation, GroundEndsOneTileBeyondTheRegion) {
  const CameraModel camera = testCamera();
  const Eigen::Vector3d up = upOf(0.5);
  const OwnedDepth<float> depth = planeDepth(camera, up, 0.9);
  RayTable rays;
  rays.build(camera);
  std::vector<std::uint8_t> region(80 * 60, 0), labels;
  const std::vector<std::uint8_t> nowhere(80 * 60, 0);
  region[40 * 80 + 30] = 1;
  GroundSegmentation segmentation;
  const DepthView view = depth.view();
  const auto counts =
      segmentation.label({view, rays, kRange}, up, 0.9, kLimits, {region, nowhere}, labels);
  EXPECT_EQ(counts.ground, 24U * 24U);
  for (int v = 280; v < 380; ++v) {
    for (int u = 200; u < 300; ++u) {
      const bool near = u >= 29 * 8 && u < 32 * 8 && v >= 39 * 8 && v < 42 * 8;
      ASSERT_EQ(labels[static_cast<std::size_t>(v * 640 + u)],
                static_cast<std::uint8_t>(near ? Label::kGround : Label::kUnknown))
          << u << ", " << v;
    }
  }
  // At the image's corners as well, and not beyond its sides.
  region.assign(region.size(), 0);
  region[59 * 80] = region[59 * 80 + 79] = 1;
  EXPECT_EQ(
      segmentation.label({view, rays, kRange}, up, 0.9, kLimits, {region, nowhere}, labels).ground,
      2U * 16U * 16U);
}

/// Within the band, a surface above the plane is obstacle and one below it drop-off; what is not on
/// that side of the plane there is unknown, and none of it is counted as ground.
TEST(GroundSegmentation, AnotherSurfaceIsNoGround) {
  const CameraModel camera = testCamera();
  const Eigen::Vector3d up = upOf(1.0);
  RayTable rays;
  rays.build(camera);
  const std::vector<std::uint8_t> everywhere(80 * 60, 1);
  std::vector<std::uint8_t> other(80 * 60, 0), labels;
  const auto expectLabel = [&](TileKind kind, double over, Label expected) {
    for (std::size_t tile = 0; tile < other.size(); ++tile) other[tile] = tile % 80 < 40 ? 0 : kind;
    const OwnedDepth<float> depth = planeDepth(camera, up, 1.0 - over);
    GroundSegmentation segmentation;
    const DepthView view = depth.view();
    const auto counts =
        segmentation.label({view, rays, kRange}, up, 1.0, kLimits, {everywhere, other}, labels);
    EXPECT_EQ(counts.ground, 320U * 480U);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const Label truth = i % 640 < 320 ? Label::kGround : expected;
      ASSERT_EQ(static_cast<Label>(labels[i]), truth) << over << ", pixel " << i;
    }
  };
  // From 0.9 to 2.1 m the band is 9 mm or more, and 0.75 sigma(z) 6.2 mm or less.
  expectLabel(kAbove, 0.0085, Label::kObstacle);
  expectLabel(kAbove, 0.001, Label::kUnknown);
  expectLabel(kAbove, -0.0085, Label::kUnknown);
  expectLabel(kBelow, -0.0085, Label::kDropOff);
  expectLabel(kBelow, -0.001, Label::kUnknown);
  expectLabel(kBelow, 0.0085, Label::kUnknown);
}

/// A hole in the floor whose bottom is beyond the working range; no hole where nothing was read,
/// where the reading is endless, and where the floor itself is as far.
TEST(GroundSegmentation, WhatIsBeyondTheRangeMayBeADropOff) {
  const CameraModel camera = testCamera();
  const Eigen::Vector3d up = upOf(0.4);
  OwnedDepth<float> depth = planeDepth(camera, up, 0.9);
  depth.at(320, 300) = 6.0F;
  depth.at(330, 300) = std::numeric_limits<float>::infinity();
  depth.at(340, 300) = 0.0F;
  depth.at(350, 300) = std::numeric_limits<float>::quiet_NaN();
  RayTable rays;
  rays.build(camera);
  int far_row = 300;
  while (depth.at(310, far_row) < 4.5F) --far_row;
  depth.at(310, far_row) = 8.0F;
  const std::vector<std::uint8_t> everywhere(80 * 60, 1), nowhere(80 * 60, 0);
  std::vector<std::uint8_t> labels;
  GroundSegmentation segmentation;
  const DepthView view = depth.view();
  segmentation.label({view, rays, kRange}, up, 0.9, kLimits, {everywhere, nowhere}, labels);
  const auto label = [&](int u, int v) {
    return static_cast<Label>(labels[static_cast<std::size_t>(v * 640 + u)]);
  };
  EXPECT_EQ(label(320, 300), Label::kDropOff);
  EXPECT_EQ(label(322, 300), Label::kGround);
  EXPECT_EQ(label(330, 300), Label::kUnknown);
  EXPECT_EQ(label(340, 300), Label::kUnknown);
  EXPECT_EQ(label(350, 300), Label::kUnknown);
  EXPECT_EQ(label(310, far_row), Label::kUnknown);
}

}  // namespace
}  // namespace dominant_plane_detection
