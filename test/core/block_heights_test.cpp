#include "core/block_heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/label_kernel.h"
#include "core/ray_table.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

constexpr ReadingRange kRange{1.0F, 0.5F, 4.0F};

struct Size {
  int width, height;
};

class BlockHeightsOfSize : public testing::TestWithParam<Size> {};

/// Readings on, above and far above a plane, out of range and missing, against sums one by one.
TEST_P(BlockHeightsOfSize, AreSumsOfCutHeights) {
  const CameraModel camera = testCamera(GetParam().width, GetParam().height);
  const Eigen::Vector3f up = upOf(0.6, -0.2).cast<float>();
  const LabelRule rule{{up.x(), up.y(), up.z()}, 1.1F, 0.01F, 0.007F};
  OwnedDepth<float> depth = planeDepth(camera, up.cast<double>(), 1.1);
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    depth.pixels[i] *= 1.0F - 0.012F * static_cast<float>(i % 7);
    if (i % 13 == 0) depth.pixels[i] = std::numeric_limits<float>::quiet_NaN();
  }
  // Nothing but far things on the right of the image.
  for (int v = 0; v < depth.height; ++v) {
    for (int u = depth.width * 3 / 4; u < depth.width; ++u) depth.at(u, v) *= 0.6F;
  }
  RayTable rays;
  rays.build(camera);
  BlockHeights blocks;
  const DepthView view = depth.view();
  const std::vector<std::uint8_t> tiles(10000, kNearGround);
  std::vector<std::uint8_t> labels(depth.pixels.size());
  runLabelKernel({view, rays, kRange}, rule, tiles.data(), labels.data(), &blocks);
  ASSERT_EQ(blocks.columns, (depth.width + 3) / 4);
  ASSERT_EQ(blocks.rows, (depth.height + 3) / 4);
  int off_blocks = 0;
  for (int y = 0; y < blocks.rows; ++y) {
    for (int x = 0; x < blocks.columns; ++x) {
      float sum = 0.0F;
      int count = 0, within = 0, near = 0, pixels = 0;
      for (int v = 4 * y; v < std::min(4 * y + 4, depth.height); ++v) {
        for (int u = 4 * x; u < std::min(4 * x + 4, depth.width); ++u, ++pixels) {
          const float z = depth.at(u, v);
          if (!(z >= 0.5F && z <= 4.0F)) continue;
          const float height = z * up.dot(rays.ray(u, v)) + 1.1F;
          const float band = 0.01F + 0.007F * z * z;
          sum += std::clamp(height, -band, band);
          ++count;
          within += std::abs(height) <= band;
          near += std::abs(height) <= 2.0F * band;
        }
      }
      const auto at = static_cast<std::size_t>(y * blocks.columns + x);
      EXPECT_NEAR(blocks.sum[at], sum, 1e-5F) << x << ", " << y;
      EXPECT_EQ(blocks.count[at], static_cast<float>(count)) << x << ", " << y;
      EXPECT_EQ(blocks.off[at] != 0, 2 * near < pixels) << x << ", " << y;
      EXPECT_EQ(blocks.beyond[at] != 0, 2 * (count - within) >= pixels) << x << ", " << y;
      off_blocks += blocks.off[at];
    }
  }
  EXPECT_GT(off_blocks, static_cast<int>(blocks.size()) / 5);
  EXPECT_LT(off_blocks, static_cast<int>(blocks.size()) * 4 / 5);
}

INSTANTIATE_TEST_SUITE_P(Sizes, BlockHeightsOfSize,
                         testing::Values(Size{640, 480}, Size{637, 475}, Size{37, 22}));

}  // namespace
}  // namespace dominant_plane_detection
