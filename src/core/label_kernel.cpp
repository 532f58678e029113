#include "core/label_kernel.h"

#include <algorithm>
#include <type_traits>

#include "dominant_plane_detection/detection.h"

// Compiled once for each instruction set, see tile_moments_kernel.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/label_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/block_sums-inl.h"
#include "core/label_rule-inl.h"
#include "core/pixel_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dominant_plane_detection {
namespace HWY_NAMESPACE {

/// Sums over the lanes' ground pixels: their number, and their squared heights [m^2].
struct VectorSums {
  Vector ground, square_height;

  HWY_INLINE VectorSums() : ground(hn::Zero(Floats())), square_height(hn::Zero(Floats())) {}

  HWY_INLINE void add(hn::Mask<Floats> is_ground, Vector height) {
    ground = hn::Add(ground, hn::IfThenElseZero(is_ground, hn::Set(Floats(), 1.0F)));
    // Without a reading the height is not a number.
    const auto counted = hn::IfThenElseZero(is_ground, height);
    square_height = hn::MulAdd(counted, counted, square_height);
  }
  HWY_INLINE void addTo(LabelSums& total) const {
    const Floats d;
    total.ground += static_cast<std::size_t>(hn::GetLane(hn::SumOfLanes(d, ground)));
    total.square_height += static_cast<double>(hn::GetLane(hn::SumOfLanes(d, square_height)));
  }
};

using Labels = hn::Vec<hn::Rebind<std::int32_t, Floats>>;

HWY_INLINE Labels constant(Label label) {
  return hn::Set(hn::Rebind<std::int32_t, Floats>(), static_cast<std::int32_t>(label));
}

HWY_INLINE void storeLabels(Labels labels, std::uint8_t* to) {
  const hn::Rebind<std::uint8_t, Floats> bytes;
  hn::StoreU(hn::DemoteTo(bytes, labels), bytes, to);
}

/// Labels the pixels of one vector, of a tile that is not smeared.
template <TileKind kKind>
HWY_INLINE void labelVector(const Points& points, const VectorRule& rule, float range_max,
                            Vector height, Vector band, hn::Mask<Floats> in_band, VectorSums& sums,
                            std::uint8_t* labels) {
  const Floats d;
  const hn::Rebind<std::int32_t, Floats> wide;
  const auto off_plane = hn::IfThenElse(hn::RebindMask(wide, hn::Gt(height, hn::Zero(d))),
                                        constant(Label::kObstacle), constant(Label::kDropOff));
  auto in_band_label = constant(kKind == kNearGround ? Label::kGround : Label::kUnknown);
  if (kKind == kAbove || kKind == kBelow) {
    const auto to_surface = kKind == kAbove ? height : hn::Neg(height);
    const auto on_surface =
        hn::Gt(to_surface, hn::Mul(hn::Set(d, kOnPlane), rule.narrowBand(points)));
    in_band_label = hn::IfThenElse(hn::RebindMask(wide, on_surface), off_plane, in_band_label);
  }
  const auto any = hn::IfThenElse(hn::RebindMask(wide, in_band), in_band_label, off_plane);
  auto label = hn::IfThenElseZero(hn::RebindMask(wide, points.valid), any);
  if (HWY_UNLIKELY(!hn::AllTrue(d, points.valid))) {
    const auto below = rule.isBelowFarthest(points, height, band, range_max);
    label = hn::IfThenElse(hn::RebindMask(wide, below), constant(Label::kDropOff), label);
  }
  storeLabels(label, labels);
  if (kKind == kNearGround) sums.add(in_band, height);
}

/// Rows of pixels as high as a block, and where their labels go.
template <typename Pixel>
struct BlockRows {
  int count = 0;  ///< [#] rows inside the image
  PixelRow<Pixel> pixels[kBlockSize];
  std::uint8_t* labels[kBlockSize];
};

/// A block's rows over the width of a tile.
/// @param first [px] column in the rows, and of the column sums at `column`.
template <bool kSeparable, bool kBlocks, TileKind kKind, typename Pixel>
HWY_INLINE void labelTile(const BlockRows<Pixel>& rows, int first, const ReadingRange& range,
                          const VectorRule& rule, VectorSums& sums, ColumnRow& columns,
                          int column) {
  const int step = static_cast<int>(hn::Lanes(Floats()));
  for (int i = 0; i < kTileSize; i += step) {
    ColumnSums column_sums;
    for (int row = 0; row < rows.count; ++row) {
      const auto points = loadPoints<kSeparable>(rows.pixels[row], first + i, range);
      const auto height = rule.height(points);
      const auto band = rule.band(points);
      const auto in_band = hn::And(points.valid, hn::Le(hn::Abs(height), band));
      labelVector<kKind>(points, rule, range.max, height, band, in_band, sums,
                         rows.labels[row] + first + i);
      if (kBlocks) column_sums.add(points, height, band, in_band);
    }
    if (kBlocks) columns.store(column_sums, column + i);
  }
}

template <bool kSeparable, bool kBlocks, typename Pixel>
HWY_INLINE void labelTile(TileKind kind, const BlockRows<Pixel>& rows, int first,
                          const ReadingRange& range, const VectorRule& rule, VectorSums& sums,
                          ColumnRow& columns, int column) {
  const auto labelAs = [&](auto constant_kind) HWY_ATTR {
    labelTile<kSeparable, kBlocks, constant_kind.value>(rows, first, range, rule, sums, columns,
                                                        column);
  };
  if (kind == kNearGround) {
    labelAs(std::integral_constant<TileKind, kNearGround>());
  } else if (kind == kElsewhere) {
    labelAs(std::integral_constant<TileKind, kElsewhere>());
  } else if (kind == kAbove) {
    labelAs(std::integral_constant<TileKind, kAbove>());
  } else {
    labelAs(std::integral_constant<TileKind, kBelow>());
  }
}

template <bool kSeparable, bool kBlocks, typename Pixel>
HWY_INLINE LabelSums labelImage(const ImageInput& input, const LabelRule& rule,
                                const std::uint8_t* tile_kinds, std::uint8_t* labels,
                                BlockHeights* blocks) {
  const VectorRule vector_rule(rule);
  const ReadingRange range = input.range;
  const int width = input.depth.width, height = input.depth.height;
  const int whole = width - width % kTileSize;
  const int tile_columns = covering(width, kTileSize);
  ColumnRow columns(blocks);
  LabelSums total;
  for (int top = 0; top < height; top += kBlockSize) {
    const std::uint8_t* tiles =
        tile_kinds + static_cast<std::ptrdiff_t>(top / kTileSize) * tile_columns;
    BlockRows<Pixel> rows;
    rows.count = std::min(kBlockSize, height - top);
    for (int row = 0; row < rows.count; ++row) {
      rows.pixels[row] = pixelRow<kSeparable, Pixel>(input, 0, top + row);
      rows.labels[row] = labels + static_cast<std::ptrdiff_t>(top + row) * width;
    }
    VectorSums sums;
    for (int u = 0; u < whole; u += kTileSize) {
      labelTile<kSeparable, kBlocks>(static_cast<TileKind>(tiles[u / kTileSize]), rows, u, range,
                                     vector_rule, sums, columns, u);
    }
    if (whole < width) {
      PaddedRow<Pixel> padded[kBlockSize];
      std::uint8_t rest_labels[kBlockSize][kTileSize];
      BlockRows<Pixel> rest;
      rest.count = rows.count;
      for (int row = 0; row < rows.count; ++row) {
        rest.pixels[row] = padded[row].template fill<kSeparable>(
            pixelRow<kSeparable, Pixel>(input, whole, top + row), width - whole);
        rest.labels[row] = rest_labels[row];
      }
      labelTile<kSeparable, kBlocks>(static_cast<TileKind>(tiles[tile_columns - 1]), rest, 0, range,
                                     vector_rule, sums, columns, whole);
      for (int row = 0; row < rows.count; ++row) {
        std::copy_n(rest_labels[row], width - whole, rows.labels[row] + whole);
      }
    }
    sums.addTo(total);
    if (kBlocks) columns.store(top / kBlockSize, rows.count, width, *blocks);
  }
  return total;
}

/// The pixels of a smeared tile's row that are within the band, but not within the narrow one,
/// become unknown.
template <bool kSeparable, typename Pixel>
HWY_INLINE void labelSmearedRow(const PixelRow<Pixel>& row, const ReadingRange& range,
                                const VectorRule& rule, VectorSums& lost, std::uint8_t* labels) {
  const Floats d;
  const hn::Rebind<std::int32_t, Floats> wide;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  for (int i = 0; i < kTileSize; i += static_cast<int>(hn::Lanes(d))) {
    const auto points = loadPoints<kSeparable>(row, i, range);
    const auto height = rule.height(points);
    const auto off = hn::Abs(height);
    const auto in_band = hn::And(points.valid, hn::Le(off, rule.band(points)));
    const auto unknown = hn::AndNot(hn::Le(off, rule.narrowBand(points)), in_band);
    const auto before = hn::PromoteTo(wide, hn::LoadU(bytes, labels + i));
    storeLabels(hn::IfThenElse(hn::RebindMask(wide, unknown), constant(Label::kUnknown), before),
                labels + i);
    lost.add(unknown, height);
  }
}

template <bool kSeparable, typename Pixel>
HWY_INLINE LabelSums labelSmearedTiles(const ImageInput& input, const LabelRule& rule,
                                       const std::uint8_t* tile_kinds, std::uint8_t* labels) {
  const VectorRule vector_rule(rule);
  const int width = input.depth.width, height = input.depth.height;
  const int columns = covering(width, kTileSize);
  LabelSums total;
  for (std::ptrdiff_t tile = 0; tile < columns * covering(height, kTileSize); ++tile) {
    if (tile_kinds[tile] != kSmeared) continue;
    VectorSums lost;
    const int left = static_cast<int>(tile % columns) * kTileSize;
    const int top = static_cast<int>(tile / columns) * kTileSize;
    for (int v = top; v < std::min(top + kTileSize, height); ++v) {
      std::uint8_t* row_labels = labels + static_cast<std::ptrdiff_t>(v) * width + left;
      const auto row = pixelRow<kSeparable, Pixel>(input, left, v);
      if (left + kTileSize <= width) {
        labelSmearedRow<kSeparable>(row, input.range, vector_rule, lost, row_labels);
        continue;
      }
      PaddedRow<Pixel> padded;
      std::uint8_t rest[kTileSize] = {};
      std::copy_n(row_labels, width - left, rest);
      labelSmearedRow<kSeparable>(padded.template fill<kSeparable>(row, width - left), input.range,
                                  vector_rule, lost, rest);
      std::copy_n(rest, width - left, row_labels);
    }
    lost.addTo(total);
  }
  return total;
}

LabelSums labelAll(const ImageInput& input, const LabelRule& rule, const std::uint8_t* tile_kinds,
                   std::uint8_t* labels, BlockHeights* blocks) {
  return visitLayout(input, [&](auto separable, auto pixel) HWY_ATTR {
    using Pixel = decltype(pixel);
    return blocks != nullptr
               ? labelImage<separable.value, true, Pixel>(input, rule, tile_kinds, labels, blocks)
               : labelImage<separable.value, false, Pixel>(input, rule, tile_kinds, labels, blocks);
  });
}

LabelSums labelAllSmeared(const ImageInput& input, const LabelRule& rule,
                          const std::uint8_t* tile_kinds, std::uint8_t* labels) {
  return visitLayout(input, [&](auto separable, auto pixel) HWY_ATTR {
    return labelSmearedTiles<separable.value, decltype(pixel)>(input, rule, tile_kinds, labels);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace dominant_plane_detection
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dominant_plane_detection {

HWY_EXPORT(labelAll);
HWY_EXPORT(labelAllSmeared);

LabelSums runLabelKernel(const ImageInput& input, const LabelRule& rule, const std::uint8_t* tiles,
                         std::uint8_t* labels, BlockHeights* blocks) {
  if (blocks != nullptr) blocks->resize(input.depth.width, input.depth.height);
  return HWY_DYNAMIC_DISPATCH(labelAll)(input, rule, tiles, labels, blocks);
}

LabelSums labelSmeared(const ImageInput& input, const LabelRule& rule, const std::uint8_t* tiles,
                       std::uint8_t* labels) {
  return HWY_DYNAMIC_DISPATCH(labelAllSmeared)(input, rule, tiles, labels);
}

}  // namespace dominant_plane_detection
#endif
