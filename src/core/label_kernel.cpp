#include "core/label_kernel.h"

#include <algorithm>

#include "dominant_plane_detection/detection.h"

// Compiled once for each instruction set, see tile_moments_kernel.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/label_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/label_rule-inl.h"
#include "core/pixel_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dominant_plane_detection {
namespace HWY_NAMESPACE {

/// Sums over the lanes' ground pixels: their number, and their squared heights [m^2].
struct VectorSums {
  Vector ground, square_height;
};

/// Labels the pixels of one vector.
template <TileKind kKind>
HWY_INLINE void labelVector(const Points& points, const VectorRule& rule, float range_max,
                            VectorSums& sums, std::uint8_t* labels) {
  const Floats d;
  const hn::Rebind<std::int32_t, Floats> wide;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  const auto height = rule.height(points);
  const auto off = hn::Abs(height);
  const auto in_band = hn::And(points.valid, hn::Le(off, rule.band(points)));
  const auto ground =
      kKind == kSmeared ? hn::And(in_band, hn::Le(off, rule.narrowBand(points))) : in_band;

  const auto constant = [&](Label label) {
    return hn::Set(wide, static_cast<std::int32_t>(label));
  };
  const auto off_plane = hn::IfThenElse(hn::RebindMask(wide, hn::Gt(height, hn::Zero(d))),
                                        constant(Label::kObstacle), constant(Label::kDropOff));
  const auto unknown = constant(Label::kUnknown);
  auto in_band_label = unknown;
  if (kKind == kAbove || kKind == kBelow) {
    const auto to_surface = kKind == kAbove ? height : hn::Neg(height);
    const auto on_surface =
        hn::Gt(to_surface, hn::Mul(hn::Set(d, kOnPlane), rule.narrowBand(points)));
    in_band_label = hn::IfThenElse(hn::RebindMask(wide, on_surface), off_plane, unknown);
  } else if (kKind != kElsewhere) {
    in_band_label = hn::IfThenElse(hn::RebindMask(wide, ground), constant(Label::kGround), unknown);
  }
  const auto any = hn::IfThenElse(hn::RebindMask(wide, in_band), in_band_label, off_plane);
  auto label = hn::IfThenElseZero(hn::RebindMask(wide, points.valid), any);
  if (HWY_UNLIKELY(!hn::AllTrue(d, points.valid))) {
    const auto below = rule.isBelowFarthest(points, height, range_max);
    label = hn::IfThenElse(hn::RebindMask(wide, below), constant(Label::kDropOff), label);
  }
  hn::StoreU(hn::DemoteTo(bytes, label), bytes, labels);
  if (kKind != kNearGround && kKind != kSmeared) return;
  sums.ground = hn::Add(sums.ground, hn::IfThenElseZero(ground, hn::Set(d, 1.0F)));
  // Without a reading the height is not a number.
  const auto counted = hn::IfThenElseZero(ground, height);
  sums.square_height = hn::MulAdd(counted, counted, sums.square_height);
}

/// The same for a tile of any kind: mostly that of the vector before.
HWY_INLINE void labelVector(const Points& points, const VectorRule& rule, float range_max,
                            std::uint8_t tile, VectorSums& sums, std::uint8_t* labels) {
  if (tile == kNearGround) {
    labelVector<kNearGround>(points, rule, range_max, sums, labels);
  } else if (tile == kElsewhere) {
    labelVector<kElsewhere>(points, rule, range_max, sums, labels);
  } else if (tile == kSmeared) {
    labelVector<kSmeared>(points, rule, range_max, sums, labels);
  } else if (tile == kAbove) {
    labelVector<kAbove>(points, rule, range_max, sums, labels);
  } else {
    labelVector<kBelow>(points, rule, range_max, sums, labels);
  }
}

template <bool kSeparable, typename Pixel>
HWY_INLINE LabelSums labelImage(const ImageInput& input, const LabelRule& rule,
                                const std::uint8_t* tile_kinds, std::uint8_t* labels) {
  const Floats d;
  const VectorRule vector_rule(rule);
  const ReadingRange range = input.range;
  const int step = static_cast<int>(hn::Lanes(d));
  const int width = input.depth.width;
  const int whole = width - width % kTileSize;
  const int columns = covering(width, kTileSize);
  LabelSums total;
  for (int v = 0; v < input.depth.height; ++v, labels += width) {
    const std::uint8_t* tiles = tile_kinds + static_cast<std::ptrdiff_t>(v / kTileSize) * columns;
    const auto row = pixelRow<kSeparable, Pixel>(input, 0, v);
    VectorSums sums{hn::Zero(d), hn::Zero(d)};
    for (int u = 0; u < whole; u += step) {
      const auto points = loadPoints<kSeparable>(row, u, range);
      labelVector(points, vector_rule, range.max, tiles[u / kTileSize], sums, labels + u);
    }
    if (whole < width) {
      PaddedRow<Pixel> padded;
      const auto rest = padded.template fill<kSeparable>(
          pixelRow<kSeparable, Pixel>(input, whole, v), width - whole);
      std::uint8_t rest_labels[kTileSize];
      for (int i = 0; i < kTileSize; i += step) {
        const auto points = loadPoints<kSeparable>(rest, i, range);
        labelVector(points, vector_rule, range.max, tiles[columns - 1], sums, rest_labels + i);
      }
      std::copy_n(rest_labels, width - whole, labels + whole);
    }
    total.ground += static_cast<std::size_t>(hn::GetLane(hn::SumOfLanes(d, sums.ground)));
    total.square_height += static_cast<double>(hn::GetLane(hn::SumOfLanes(d, sums.square_height)));
  }
  return total;
}

LabelSums labelAll(const ImageInput& input, const LabelRule& rule, const std::uint8_t* tile_kinds,
                   std::uint8_t* labels) {
  return visitLayout(input, [&](auto separable, auto pixel) HWY_ATTR {
    return labelImage<separable.value, decltype(pixel)>(input, rule, tile_kinds, labels);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace dominant_plane_detection
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dominant_plane_detection {

HWY_EXPORT(labelAll);

LabelSums runLabelKernel(const ImageInput& input, const LabelRule& rule,
                         const std::uint8_t* tile_kinds, std::uint8_t* labels) {
  return HWY_DYNAMIC_DISPATCH(labelAll)(input, rule, tile_kinds, labels);
}

}  // namespace dominant_plane_detection
#endif
