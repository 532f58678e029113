#include "core/block_heights.h"

#include <algorithm>

// Compiled once for each instruction set, see tile_moments_kernel.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/block_heights.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/label_rule-inl.h"
#include "core/pixel_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dominant_plane_detection {
namespace HWY_NAMESPACE {

/// A reading counts 1, one within twice the band this much more and one within the band its square
/// more, so that one sum holds all three counts of a block's 16 pixels.
constexpr int kDigit = 32;

/// Sums over the rows of a block, a number each column; as wide as a tile, so two blocks.
struct ColumnSums {
  float height[kTileSize];  ///< [m]
  float count[kTileSize];   ///< [#] see kDigit
};

template <bool kSeparable, typename Pixel>
HWY_INLINE void sumColumns(const PixelRow<Pixel>* rows, int row_count, const ReadingRange& range,
                           const VectorRule& rule, ColumnSums& sums) {
  const Floats d;
  const auto two = hn::Set(d, 2.0F);
  for (int i = 0; i < kTileSize; i += static_cast<int>(hn::Lanes(d))) {
    auto height_sum = hn::Zero(d), count = hn::Zero(d);
    for (int row = 0; row < row_count; ++row) {
      const auto point = loadPoints<kSeparable>(rows[row], i, range);
      const auto height = rule.height(point);
      const auto band = rule.band(point);
      const auto cut = hn::Min(hn::Max(height, hn::Neg(band)), band);
      height_sum = hn::Add(height_sum, hn::IfThenElseZero(point.valid, cut));
      const auto within = hn::And(point.valid, hn::Le(hn::Abs(height), band));
      const auto near = hn::And(point.valid, hn::Le(hn::Abs(height), hn::Mul(two, band)));
      count = hn::Add(count, hn::IfThenElseZero(point.valid, hn::Set(d, 1.0F)));
      count = hn::Add(count, hn::IfThenElseZero(near, hn::Set(d, float{kDigit})));
      count = hn::Add(count, hn::IfThenElseZero(within, hn::Set(d, float{kDigit * kDigit})));
    }
    hn::StoreU(height_sum, d, sums.height + i);
    hn::StoreU(count, d, sums.count + i);
  }
}

/// @param pixels [px] of the block inside the image.
HWY_INLINE void storeBlock(const ColumnSums& sums, int first, int pixels, std::size_t block,
                           BlockHeights& blocks) {
  float height = 0.0F;
  int counts = 0;
  for (int i = first; i < first + kBlockSize; ++i) {
    height += sums.height[i];
    counts += static_cast<int>(sums.count[i]);
  }
  const int count = counts % kDigit;
  const int near = counts / kDigit % kDigit;
  const int within = counts / (kDigit * kDigit);
  blocks.sum[block] = height;
  blocks.count[block] = static_cast<float>(count);
  blocks.beyond[block] = 2 * (count - within) >= pixels;
  blocks.off[block] = 2 * near < pixels;
}

template <bool kSeparable, typename Pixel>
HWY_INLINE void computeBlocks(const ImageInput& input, const LabelRule& rule,
                              BlockHeights& blocks) {
  const DepthView& depth = input.depth;
  PixelRow<Pixel> rows[kBlockSize];
  PaddedRow<Pixel> padded[kBlockSize];
  const VectorRule vector_rule(rule);
  ColumnSums sums;
  for (int block_row = 0; block_row < blocks.rows; ++block_row) {
    const int top = block_row * kBlockSize;
    const int row_count = std::min(kBlockSize, depth.height - top);
    for (int u = 0; u < depth.width; u += kTileSize) {
      const int width = std::min(kTileSize, depth.width - u);
      for (int row = 0; row < row_count; ++row) {
        rows[row] = pixelRow<kSeparable, Pixel>(input, u, top + row);
        if (width < kTileSize) rows[row] = padded[row].template fill<kSeparable>(rows[row], width);
      }
      sumColumns<kSeparable>(rows, row_count, input.range, vector_rule, sums);
      for (int first = 0; first < width; first += kBlockSize) {
        const std::size_t block = static_cast<std::size_t>(block_row * blocks.columns) +
                                  static_cast<std::size_t>((u + first) / kBlockSize);
        storeBlock(sums, first, row_count * std::min(kBlockSize, width - first), block, blocks);
      }
    }
  }
}

void computeAllBlocks(const ImageInput& input, const LabelRule& rule, BlockHeights& blocks) {
  visitLayout(input, [&](auto separable, auto pixel) HWY_ATTR {
    computeBlocks<separable.value, decltype(pixel)>(input, rule, blocks);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace dominant_plane_detection
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dominant_plane_detection {

HWY_EXPORT(computeAllBlocks);

void computeBlockHeights(const ImageInput& input, const LabelRule& rule, BlockHeights& blocks) {
  blocks.columns = covering(input.depth.width, kBlockSize);
  blocks.rows = covering(input.depth.height, kBlockSize);
  blocks.sum.resize(blocks.size());
  blocks.count.resize(blocks.size());
  blocks.beyond.resize(blocks.size());
  blocks.off.resize(blocks.size());
  HWY_DYNAMIC_DISPATCH(computeAllBlocks)(input, rule, blocks);
}

}  // namespace dominant_plane_detection
#endif
