#include "core/label_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/ray_table.h"
#include "dominant_plane_detection/detection.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

constexpr ReadingRange kRange{1.0F, 0.5F, 4.0F};
constexpr auto kGround = static_cast<std::uint8_t>(Label::kGround);
constexpr auto kUnknown = static_cast<std::uint8_t>(Label::kUnknown);

struct Size {
  int width, height;
};

class LabelKernelOfSize : public testing::TestWithParam<Size> {};

/// Every third tile is smeared: there, what is beyond the narrow band is ground no more.
TEST_P(LabelKernelOfSize, SmearedTilesLoseWhatIsBeyondTheNarrowBand) {
  const CameraModel camera = testCamera(GetParam().width, GetParam().height);
  const Eigen::Vector3f up = upOf(0.6, -0.2).cast<float>();
  const LabelRule rule{{up.x(), up.y(), up.z()}, 1.1F, 0.01F, 0.007F, 0.004F, 0.002F};
  OwnedDepth<float> depth = planeDepth(camera, up.cast<double>(), 1.1);
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    depth.pixels[i] *= 1.0F + 0.006F * (static_cast<float>(i % 7) - 3.0F);
    if (i % 13 == 0) depth.pixels[i] = std::numeric_limits<float>::quiet_NaN();
  }
  RayTable rays;
  rays.build(camera);
  const int columns = covering(depth.width, 8), rows = covering(depth.height, 8);
  std::vector<std::uint8_t> tiles(static_cast<std::size_t>(columns * rows), kNearGround);
  std::vector<std::uint8_t> labels(depth.pixels.size());
  const DepthView view = depth.view();
  const ImageInput input{view, rays, kRange};
  const LabelSums before = runLabelKernel(input, rule, tiles.data(), labels.data(), nullptr);
  std::vector<std::uint8_t> expected = labels;
  for (std::size_t tile = 0; tile < tiles.size(); tile += 3) tiles[tile] = kSmeared;
  std::size_t lost = 0, ground = 0;
  double square_height = 0.0;
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      const float z = depth.at(u, v);
      const float height = z * up.dot(rays.ray(u, v)) + 1.1F;
      std::uint8_t& label = expected[static_cast<std::size_t>(v * depth.width + u)];
      ground += label == kGround;
      if (tiles[static_cast<std::size_t>(v / 8 * columns + u / 8)] != kSmeared ||
          label != kGround || std::abs(height) <= 0.004F + 0.002F * z * z) {
        continue;
      }
      label = kUnknown;
      ++lost;
      square_height += static_cast<double>(height) * static_cast<double>(height);
    }
  }
  const LabelSums sums = labelSmeared(input, rule, tiles.data(), labels.data());
  EXPECT_EQ(labels, expected);
  EXPECT_EQ(before.ground, ground);
  EXPECT_EQ(sums.ground, lost);
  EXPECT_GT(lost, depth.pixels.size() / 50);
  EXPECT_NEAR(sums.square_height, square_height, 1e-4 * square_height);
}

INSTANTIATE_TEST_SUITE_P(Sizes, LabelKernelOfSize,
                         testing::Values(Size{640, 480}, Size{637, 475}, Size{37, 22}));

}  // namespace
}  // namespace dominant_plane_detection
