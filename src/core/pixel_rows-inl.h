// Loading of pixels and rays into vectors; part of every kernel, once for each instruction set.
#if defined(DPD_PIXEL_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DPD_PIXEL_ROWS_INL
#undef DPD_PIXEL_ROWS_INL
#else
#define DPD_PIXEL_ROWS_INL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "core/image_kernel.h"
#include "core/tile_moments.h"

HWY_BEFORE_NAMESPACE();
namespace dominant_plane_detection {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// As many lanes as there are, at most a tile's width.
using Floats = hn::CappedTag<float, kTileSize>;

/// Neighbouring pixels of one image row with their rays.
template <typename Pixel>
struct PixelRow {
  const Pixel* pixels;
  const float* x;
  const float* y;  ///< one value for the row where the rays are separable
};

template <bool kSeparable, typename Pixel>
HWY_INLINE PixelRow<Pixel> pixelRow(const ImageInput& input, int u, int v) {
  return {input.depth.row<Pixel>(v) + u, input.rays.x(v) + u,
          input.rays.y(v) + (kSeparable ? 0 : u)};
}

/// A tile's width of pixels at the right border, filled up with "no reading".
template <typename Pixel>
struct PaddedRow {
  Pixel pixels[kTileSize] = {};
  float x[kTileSize] = {};
  float y[kTileSize] = {};

  template <bool kSeparable>
  PixelRow<Pixel> fill(const PixelRow<Pixel>& row, int width) {
    std::copy_n(row.pixels, width, pixels);
    std::copy_n(row.x, width, x);
    std::copy_n(row.y, kSeparable ? 1 : width, y);
    return {pixels, x, y};
  }
};

using Vector = hn::Vec<Floats>;

struct Points {
  hn::Mask<Floats> valid;  ///< reading within the range, and a ray
  Vector z;                ///< [m] as read
  Vector ray_x;            ///< [-] X/Z
  Vector ray_y;            ///< [-] Y/Z
};

HWY_INLINE Vector loadReadings(const float* pixels) { return hn::LoadU(Floats(), pixels); }
HWY_INLINE Vector loadReadings(const std::uint16_t* pixels) {
  const Floats d;
  const hn::Rebind<std::uint16_t, Floats> narrow;
  const hn::Rebind<std::int32_t, Floats> wide;
  return hn::ConvertTo(d, hn::PromoteTo(wide, hn::LoadU(narrow, pixels)));
}

template <bool kSeparable, typename Pixel>
HWY_INLINE Points loadPoints(const PixelRow<Pixel>& row, int i, const ReadingRange& range) {
  const Floats d;
  Points points;
  points.z = hn::Mul(loadReadings(row.pixels + i), hn::Set(d, range.metres_per_unit));
  points.ray_x = hn::LoadU(d, row.x + i);
  points.ray_y = kSeparable ? hn::Set(d, *row.y) : hn::LoadU(d, row.y + (kSeparable ? 0 : i));
  // Comparisons with NaN are false: neither a NaN reading nor a NaN ray is valid.
  points.valid =
      hn::And(hn::Ge(points.z, hn::Set(d, range.min)), hn::Le(points.z, hn::Set(d, range.max)));
  if (!kSeparable) points.valid = hn::And(points.valid, hn::Eq(points.ray_x, points.ray_x));
  return points;
}

/// Calls visit(separable, pixel) with values whose types tell how the image's rays and its pixels
/// are stored.
template <typename Visitor>
HWY_INLINE auto visitLayout(const ImageInput& input, Visitor&& visit) {
  const bool separable = input.rays.separable();
  if (input.depth.type == DepthView::Type::kUint16) {
    return separable ? visit(std::true_type(), std::uint16_t())
                     : visit(std::false_type(), std::uint16_t());
  }
  return separable ? visit(std::true_type(), 0.0F) : visit(std::false_type(), 0.0F);
}

}  // namespace HWY_NAMESPACE
}  // namespace dominant_plane_detection
HWY_AFTER_NAMESPACE();

#endif
