// Sums of heights in blocks, from sums over columns; part of the label kernel, once for each
// instruction set.
#if defined(DPD_BLOCK_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DPD_BLOCK_SUMS_INL
#undef DPD_BLOCK_SUMS_INL
#else
#define DPD_BLOCK_SUMS_INL
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "core/block_heights.h"
#include "core/pixel_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dominant_plane_detection {
namespace HWY_NAMESPACE {

/// A reading counts 1, one within twice the band this much more and one within the band its square
/// more, so that one sum holds all three counts of a block's 16 pixels.
constexpr int kDigit = 32;

/// Sums over the rows of a block, for neighbouring columns.
struct ColumnSums {
  Vector height;  ///< [m]
  Vector count;   ///< [#] see kDigit

  HWY_INLINE ColumnSums() : height(hn::Zero(Floats())), count(hn::Zero(Floats())) {}

  /// @param in_band of the points, which are valid there.
  HWY_INLINE void add(const Points& points, Vector point_height, Vector band,
                      hn::Mask<Floats> in_band) {
    const Floats d;
    const auto cut = hn::Min(hn::Max(point_height, hn::Neg(band)), band);
    const auto near = hn::And(points.valid, hn::Le(hn::Abs(point_height), hn::Add(band, band)));
    height = hn::Add(height, hn::IfThenElseZero(points.valid, cut));
    const auto counts =
        hn::Add(hn::IfThenElseZero(points.valid, hn::Set(d, 1.0F)),
                hn::Add(hn::IfThenElseZero(near, hn::Set(d, float{kDigit})),
                        hn::IfThenElseZero(in_band, hn::Set(d, float{kDigit * kDigit}))));
    count = hn::Add(count, counts);
  }
};

/// The column sums of one row of blocks.
class ColumnRow {
 public:
  /// @param blocks nullptr: nothing is stored.
  HWY_INLINE explicit ColumnRow(BlockHeights* blocks)
      : height_(blocks == nullptr ? nullptr : blocks->column_height.data()),
        count_(blocks == nullptr ? nullptr : blocks->column_count.data()) {}

  HWY_INLINE void store(const ColumnSums& sums, int column) {
    const Floats d;
    hn::StoreU(sums.height, d, height_ + column);
    hn::StoreU(sums.count, d, count_ + column);
  }

  /// Sums columns to blocks.
  /// @param row_count [px] rows of the blocks inside the image.
  /// @param width [px] of the image.
  HWY_INLINE void store(int block_row, int row_count, int width, BlockHeights& blocks) {
    const std::size_t first = static_cast<std::size_t>(block_row * blocks.columns);
    const int lanes = static_cast<int>(hn::Lanes(Floats()));
    const int whole = width / kBlockSize;
    int x = 0;
    for (; x + lanes <= whole; x += lanes) {
      storeVector(x, static_cast<float>(row_count * kBlockSize), first, blocks);
    }
    for (; x < blocks.columns; ++x) {
      const int pixels = row_count * std::min(kBlockSize, width - x * kBlockSize);
      storeBlock(x, pixels, first, blocks);
    }
  }

 private:
  HWY_INLINE void storeVector(int x, float pixels, std::size_t first, BlockHeights& blocks) const {
    const Floats d;
    const hn::Rebind<std::int32_t, Floats> wide;
    const hn::Rebind<std::uint8_t, Floats> bytes;
    Vector a, b, c, e;
    hn::LoadInterleaved4(d, height_ + x * kBlockSize, a, b, c, e);
    const std::size_t at = first + static_cast<std::size_t>(x);
    hn::StoreU(hn::Add(hn::Add(hn::Add(a, b), c), e), d, blocks.sum.data() + at);
    hn::LoadInterleaved4(d, count_ + x * kBlockSize, a, b, c, e);
    const auto counts = hn::Add(hn::Add(hn::Add(a, b), c), e);
    const auto within = hn::Floor(hn::Mul(counts, hn::Set(d, 1.0F / (kDigit * kDigit))));
    const auto rest = hn::NegMulAdd(within, hn::Set(d, float{kDigit * kDigit}), counts);
    const auto near = hn::Floor(hn::Mul(rest, hn::Set(d, 1.0F / kDigit)));
    const auto count = hn::NegMulAdd(near, hn::Set(d, float{kDigit}), rest);
    hn::StoreU(count, d, blocks.count.data() + at);
    const auto half = hn::Set(d, 0.5F * pixels);
    const auto storeMask = [&](hn::Mask<Floats> mask, std::uint8_t* to) HWY_ATTR {
      const auto ones = hn::IfThenElseZero(hn::RebindMask(wide, mask), hn::Set(wide, 1));
      hn::StoreU(hn::DemoteTo(bytes, ones), bytes, to);
    };
    storeMask(hn::Ge(hn::Sub(count, within), half), blocks.beyond.data() + at);
    storeMask(hn::Lt(near, half), blocks.off.data() + at);
  }

  void storeBlock(int x, int pixels, std::size_t first, BlockHeights& blocks) const {
    float height = 0.0F;
    int counts = 0;
    for (int i = x * kBlockSize; i < (x + 1) * kBlockSize; ++i) {
      height += height_[i];
      counts += static_cast<int>(count_[i]);
    }
    const int count = counts % kDigit;
    const int near = counts / kDigit % kDigit;
    const int within = counts / (kDigit * kDigit);
    const std::size_t at = first + static_cast<std::size_t>(x);
    blocks.sum[at] = height;
    blocks.count[at] = static_cast<float>(count);
    blocks.beyond[at] = 2 * (count - within) >= pixels;
    blocks.off[at] = 2 * near < pixels;
  }

  float* height_;  ///< [m]
  float* count_;   ///< [#] see kDigit
};

}  // namespace HWY_NAMESPACE
}  // namespace dominant_plane_detection
HWY_AFTER_NAMESPACE();

#endif
