#include "core/ground_segmentation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/ray_table.h"
#include "dominant_plane_detection/detection.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

const SegmentationLimits kLimits{0.5F, 4.0F, NoiseModel{0.002, 1.425e-3}, DepthThreshold{0.0, 3.0},
                                 0};

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
  const SegmentationCounts counts =
      segmentation.label(depth.view(), rays, up, height, kLimits, labels);
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

/// A wall 2 m away with floor-high readings in two places: a patch of 20 x 20 pixels and a speck.
TEST(GroundSegmentation, SpecksAreNoGroundPatchesAre) {
  const CameraModel camera = testCamera();
  const Eigen::Vector3d up = upOf(0.5);
  OwnedDepth<float> depth = planeDepth(camera, up, 0.9);
  OwnedDepth<float> scene(camera.width, camera.height);
  const auto copy = [&](int left, int top, int size) {
    for (int v = top; v < top + size; ++v) {
      for (int u = left; u < left + size; ++u) scene.at(u, v) = depth.at(u, v);
    }
  };
  copy(100, 300, 20);
  copy(400, 300, 19);
  RayTable rays;
  rays.build(camera);
  GroundSegmentation segmentation;
  std::vector<std::uint8_t> labels;
  SegmentationLimits limits = kLimits;
  limits.min_patch = 400;
  const auto counts = segmentation.label(scene.view(), rays, up, 0.9, limits, labels);
  EXPECT_EQ(counts.ground, 400U);
  EXPECT_EQ(labels[310 * 640 + 110], static_cast<std::uint8_t>(Label::kGround));
  EXPECT_EQ(labels[310 * 640 + 410], static_cast<std::uint8_t>(Label::kUnknown));
}

}  // namespace
}  // namespace dominant_plane_detection
