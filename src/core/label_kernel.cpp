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
HWY_INLINE void labelVector(const Points& points, const VectorRule& rule, VectorSums& sums,
                            std::uint8_t* labels) {
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
  const auto on_plane = kKind == kElsewhere
                            ? constant(Label::kUnknown)
                            : hn::IfThenElse(hn::RebindMask(wide, ground), constant(Label::kGround),
                                             constant(Label::kUnknown));
  const auto any = hn::IfThenElse(hn::RebindMask(wide, in_band), on_plane, off_plane);
  const auto label = hn::IfThenElseZero(hn::RebindMask(wide, points.valid), any);
  hn::StoreU(hn::DemoteTo(bytes, label), bytes, labels);
  if (kKind == kElsewhere) return;
  sums.ground = hn::Add(sums.ground, hn::IfThenElseZero(ground, hn::Set(d, 1.0F)));
  // Without a reading the height is not a number.
  const auto counted = hn::IfThenElseZero(ground, height);
  sums.square_height = hn::MulAdd(counted, counted, sums.square_height);
}

/// The same for a tile of any kind: mostly that of the vector before.
HWY_INLINE void labelVector(const Points& points, const VectorRule& rule, std::uint8_t tile,
                            VectorSums& sums, std::uint8_t* labels) {
  if (tile == kNearGround) {
    labelVector<kNearGround>(points, rule, sums, labels);
  } else if (tile == kElsewhere) {
    labelVector<kElsewhere>(points, rule, sums, labels);
  } else {
    labelVector<kSmeared>(points, rule, sums, labels);
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
      labelVector(points, vector_rule, tiles[u / kTileSize], sums, labels + u);
    }
    if (whole < width) {
      PaddedRow<Pixel> padded;
      const auto rest = padded.template fill<kSeparable>(
          pixelRow<kSeparable, Pixel>(input, whole, v), width - whole);
      std::uint8_t rest_labels[kTileSize];
      for (int i = 0; i < kTileSize; i += step) {
        const auto points = loadPoints<kSeparable>(rest, i, range);
        labelVector(points, vector_rule, tiles[columns - 1], sums, rest_labels + i);
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
