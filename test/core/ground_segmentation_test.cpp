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
  for (std::size_t i = 0; i < region.size(); ++i) {
    const int column = static_cast<int>(i) % columns;
    region[i] = columns < 10 || (column >= 10 && column % 2 == 0);
  }
  const SegmentationCounts counts =
      segmentation.label({view, rays, kRange}, up, height, kLimits, region, labels);
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
      if (!(z >= 0.5 && z <= 4.0)) expected = Label::kUnknown;
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
  region[40 * 80 + 30] = 1;
  GroundSegmentation segmentation;
  const DepthView view = depth.view();
  const auto counts = segmentation.label({view, rays, kRange}, up, 0.9, kLimits, region, labels);
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
  EXPECT_EQ(segmentation.label({view, rays, kRange}, up, 0.9, kLimits, region, labels).ground,
            2U * 16U * 16U);
}

}  // namespace
}  // namespace dominant_plane_detection
