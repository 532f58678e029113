#include "core/label_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
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

/// Readings on a plane, above and below it, and missing, in images that tiles cover and others.
class LabelKernelOfSize : public testing::TestWithParam<Size> {
 protected:
  LabelKernelOfSize() { rays_.build(camera_); }

  /// @param factor of the depth of a pixel, by its running number modulo 7.
  void bend(const std::function<float(float)>& factor) {
    for (std::size_t i = 0; i < depth_.pixels.size(); ++i) {
      depth_.pixels[i] *= factor(static_cast<float>(i % 7));
      if (i % 13 == 0) depth_.pixels[i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  /// @return [m]
  float heightAt(int u, int v) { return depth_.at(u, v) * up_.dot(rays_.ray(u, v)) + 1.1F; }

  const CameraModel camera_ = testCamera(GetParam().width, GetParam().height);
  const Eigen::Vector3f up_ = upOf(0.6, -0.2).cast<float>();
  const LabelRule rule_{{up_.x(), up_.y(), up_.z()}, 1.1F, 0.01F, 0.007F, 0.004F, 0.002F};
  OwnedDepth<float> depth_ = planeDepth(camera_, up_.cast<double>(), 1.1);
  RayTable rays_;
  std::vector<std::uint8_t> labels_ = std::vector<std::uint8_t>(depth_.pixels.size());
};

/// Readings on, above and far above a plane, out of range and missing, against sums one by one.
TEST_P(LabelKernelOfSize, BlocksAreSumsOfCutHeights) {
  bend([](float i) { return 1.0F - 0.012F * i; });
  // Nothing but far things on the right of the image.
  for (int v = 0; v < depth_.height; ++v) {
    for (int u = depth_.width * 3 / 4; u < depth_.width; ++u) depth_.at(u, v) *= 0.6F;
  }
  BlockHeights blocks;
  const DepthView view = depth_.view();
  const std::vector<std::uint8_t> tiles(10000, kNearGround);
  runLabelKernel({view, rays_, kRange}, rule_, tiles.data(), labels_.data(), &blocks);
  ASSERT_EQ(blocks.columns, (depth_.width + 3) / 4);
  ASSERT_EQ(blocks.rows, (depth_.height + 3) / 4);
  int off_blocks = 0;
  for (int y = 0; y < blocks.rows; ++y) {
    for (int x = 0; x < blocks.columns; ++x) {
      float sum = 0.0F;
      int count = 0, within = 0, near = 0, pixels = 0;
      for (int v = 4 * y; v < std::min(4 * y + 4, depth_.height); ++v) {
        for (int u = 4 * x; u < std::min(4 * x + 4, depth_.width); ++u, ++pixels) {
          const float z = depth_.at(u, v);
          if (!(z >= 0.5F && z <= 4.0F)) continue;
          const float height = heightAt(u, v);
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

/// Every third tile is smeared: there, what is beyond the narrow band is ground no more.
TEST_P(LabelKernelOfSize, SmearedTilesLoseWhatIsBeyondTheNarrowBand) {
  bend([](float i) { return 1.0F + 0.006F * (i - 3.0F); });
  const int columns = covering(depth_.width, 8), rows = covering(depth_.height, 8);
  std::vector<std::uint8_t> tiles(static_cast<std::size_t>(columns * rows), kNearGround);
  const DepthView view = depth_.view();
  const ImageInput input{view, rays_, kRange};
  const LabelSums before = runLabelKernel(input, rule_, tiles.data(), labels_.data(), nullptr);
  std::vector<std::uint8_t> expected = labels_;
  for (std::size_t tile = 0; tile < tiles.size(); tile += 3) tiles[tile] = kSmeared;
  std::size_t lost = 0, ground = 0;
  double square_height = 0.0;
  for (int v = 0; v < depth_.height; ++v) {
    for (int u = 0; u < depth_.width; ++u) {
      const float z = depth_.at(u, v);
      const float height = heightAt(u, v);
      std::uint8_t& label = expected[static_cast<std::size_t>(v * depth_.width + u)];
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
  const LabelSums sums = labelSmeared(input, rule_, tiles.data(), labels_.data());
  EXPECT_EQ(labels_, expected);
  EXPECT_EQ(before.ground, ground);
  EXPECT_EQ(sums.ground, lost);
  EXPECT_GT(lost, depth_.pixels.size() / 50);
  EXPECT_NEAR(sums.square_height, square_height, 1e-4 * square_height);
}

INSTANTIATE_TEST_SUITE_P(Sizes, LabelKernelOfSize,
                         testing::Values(Size{640, 480}, Size{637, 475}, Size{37, 22}));

}  // namespace
}  // namespace dominant_plane_detection
