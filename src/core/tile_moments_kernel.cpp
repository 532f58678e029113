#include "core/tile_moments_kernel.h"

#include <algorithm>
#include <array>

// Highway compiles what stands between HWY_BEFORE_NAMESPACE and HWY_AFTER_NAMESPACE once for each
// instruction set, by including this file again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/tile_moments_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/pixel_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dominant_plane_detection {
namespace HWY_NAMESPACE {

constexpr int kSums = 10;

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE void addTotals(Vector a, Vector b, Vector c, Vector e, float* totals) {
  totals[0] += hn::GetLane(a);
  totals[1] += hn::GetLane(b);
  totals[2] += hn::GetLane(c);
  totals[3] += hn::GetLane(e);
}
#else
/// Adds the sums over the lanes of four vectors to four neighbouring floats; a third of the work of
/// four sums one by one.
HWY_INLINE void addTotals(Vector a, Vector b, Vector c, Vector e, float* totals) {
  const Floats d;
  const hn::Repartition<double, Floats> pairs;
  const hn::CappedTag<float, 4> four;
  // Blocks of four lanes: (a0 + a2, b0 + b2, a1 + a3, b1 + b3).
  const auto ab = hn::Add(hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b));
  const auto ce = hn::Add(hn::InterleaveLower(d, c, e), hn::InterleaveUpper(d, c, e));
  const auto low = hn::InterleaveLower(pairs, hn::BitCast(pairs, ab), hn::BitCast(pairs, ce));
  const auto high = hn::InterleaveUpper(pairs, hn::BitCast(pairs, ab), hn::BitCast(pairs, ce));
  const auto blocks = hn::Add(hn::BitCast(d, low), hn::BitCast(d, high));
  alignas(32) float sums[kTileSize];
  hn::Store(blocks, d, sums);
  auto total = hn::LoadU(four, totals);
  for (std::size_t i = 0; i < hn::Lanes(d); i += 4) {
    total = hn::Add(total, hn::Load(four, sums + i));
  }
  hn::StoreU(total, four, totals);
}
#endif

/// Sums over the readings of a tile, relative to a reference point near them: close to the origin
/// of the sums, float keeps the plane's thickness.
template <bool kSeparable, typename Pixel>
HWY_INLINE void sumTile(const PixelRow<Pixel>* rows, int row_count, const ReadingRange& range,
                        const std::array<float, 3>& reference, std::array<float, kSums>& totals) {
  const Floats d;
  const auto x0 = hn::Set(d, reference[0]);
  const auto y0 = hn::Set(d, reference[1]);
  const auto z0 = hn::Set(d, reference[2]);
  for (int i = 0; i < kTileSize; i += static_cast<int>(hn::Lanes(d))) {
    auto sx = hn::Zero(d), sy = sx, sz = sx;
    auto sxx = sx, sxy = sx, sxz = sx, syy = sx, syz = sx, szz = sx;
    std::size_t count = 0;  // a tenth vector of sums would not fit into the registers
    for (int row = 0; row < row_count; ++row) {
      const auto point = loadPoints<kSeparable>(rows[row], i, range);
      const auto dx = hn::IfThenElseZero(point.valid, hn::MulSub(point.z, point.ray_x, x0));
      const auto dy = hn::IfThenElseZero(point.valid, hn::MulSub(point.z, point.ray_y, y0));
      const auto dz = hn::IfThenElseZero(point.valid, hn::Sub(point.z, z0));
      count += hn::CountTrue(d, point.valid);
      sx = hn::Add(sx, dx);
      sy = hn::Add(sy, dy);
      sz = hn::Add(sz, dz);
      sxx = hn::MulAdd(dx, dx, sxx);
      sxy = hn::MulAdd(dx, dy, sxy);
      sxz = hn::MulAdd(dx, dz, sxz);
      syy = hn::MulAdd(dy, dy, syy);
      syz = hn::MulAdd(dy, dz, syz);
      szz = hn::MulAdd(dz, dz, szz);
    }
    totals[0] += static_cast<float>(count);
    addTotals(sx, sy, sz, sxx, &totals[1]);
    addTotals(sxy, sxz, syy, syz, &totals[5]);
    totals[9] += hn::GetLane(hn::SumOfLanes(d, szz));
  }
}

HWY_INLINE void storeTile(const std::array<float, kSums>& totals,
                          const std::array<float, 3>& reference, std::size_t tile,
                          TileMoments& tiles) {
  const float count = totals[0];
  const float present = count > 0.0F ? 1.0F : 0.0F;
  const float inverse = present / std::max(count, 1.0F);
  const float mx = totals[1] * inverse;
  const float my = totals[2] * inverse;
  const float mz = totals[3] * inverse;
  tiles.count[tile] = count;
  tiles.x[tile] = present * reference[0] + mx;
  tiles.y[tile] = present * reference[1] + my;
  tiles.z[tile] = present * reference[2] + mz;
  tiles.xx[tile] = totals[4] * inverse - mx * mx;
  tiles.xy[tile] = totals[5] * inverse - mx * my;
  tiles.xz[tile] = totals[6] * inverse - mx * mz;
  tiles.yy[tile] = totals[7] * inverse - my * my;
  tiles.yz[tile] = totals[8] * inverse - my * mz;
  tiles.zz[tile] = totals[9] * inverse - mz * mz;
}

template <bool kSeparable, typename Pixel>
HWY_INLINE bool anyReading(const PixelRow<Pixel>* rows, int row_count, const ReadingRange& range) {
  const Floats d;
  auto any = hn::MaskFromVec(hn::Zero(d));
  for (int row = 0; row < row_count; ++row) {
    for (int i = 0; i < kTileSize; i += static_cast<int>(hn::Lanes(d))) {
      any = hn::Or(any, loadPoints<kSeparable>(rows[row], i, range).valid);
    }
  }
  return !hn::AllFalse(d, any);
}

/// Sets `reference` to one of the tile's points, its middle one if that has a reading.
/// @return false for a tile without a reading.
template <bool kSeparable, typename Pixel>
HWY_INLINE bool findReference(const PixelRow<Pixel>* rows, int row_count, const ReadingRange& range,
                              std::array<float, 3>& reference) {
  const auto try_pixel = [&](int pixel) {
    const PixelRow<Pixel>& row = rows[pixel / kTileSize];
    const int column = pixel % kTileSize;
    const float z = static_cast<float>(row.pixels[column]) * range.metres_per_unit;
    const float x = row.x[column];
    const float y = row.y[kSeparable ? 0 : column];
    // Where the lens model cannot be inverted, x is NaN.
    if (!(z >= range.min && z <= range.max && x == x)) return false;
    reference = {z * x, z * y, z};
    return true;
  };
  if (try_pixel(row_count / 2 * kTileSize + kTileSize / 2)) return true;
  if (!anyReading<kSeparable>(rows, row_count, range)) return false;
  for (int pixel = 0; pixel < row_count * kTileSize; ++pixel) {
    if (try_pixel(pixel)) return true;
  }
  return false;
}

template <bool kSeparable, typename Pixel>
HWY_INLINE void computeTile(const PixelRow<Pixel>* rows, int row_count, const ReadingRange& range,
                            std::size_t tile, TileMoments& tiles) {
  std::array<float, 3> reference{};
  std::array<float, kSums> totals{};
  if (findReference<kSeparable>(rows, row_count, range, reference)) {
    sumTile<kSeparable>(rows, row_count, range, reference, totals);
  }
  storeTile(totals, reference, tile, tiles);
}

template <bool kSeparable, typename Pixel>
HWY_INLINE void computeTiles(const ImageInput& input, TileMoments& tiles) {
  const DepthView& depth = input.depth;
  const int whole_columns = depth.width / kTileSize;
  std::size_t tile = 0;
  PixelRow<Pixel> rows[kTileSize];
  for (int top = 0; top < depth.height; top += kTileSize) {
    const int row_count = std::min(kTileSize, depth.height - top);
    for (int column = 0; column < whole_columns; ++column) {
      for (int row = 0; row < row_count; ++row) {
        rows[row] = pixelRow<kSeparable, Pixel>(input, column * kTileSize, top + row);
      }
      computeTile<kSeparable>(rows, row_count, input.range, tile++, tiles);
    }
    if (whole_columns == tiles.columns) continue;
    PaddedRow<Pixel> padded[kTileSize];
    for (int row = 0; row < row_count; ++row) {
      const int left = whole_columns * kTileSize;
      rows[row] = padded[row].template fill<kSeparable>(
          pixelRow<kSeparable, Pixel>(input, left, top + row), depth.width - left);
    }
    computeTile<kSeparable>(rows, row_count, input.range, tile++, tiles);
  }
}

void computeAllTiles(const ImageInput& input, TileMoments& tiles) {
  visitLayout(input, [&](auto separable, auto pixel) HWY_ATTR {
    computeTiles<separable.value, decltype(pixel)>(input, tiles);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace dominant_plane_detection
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dominant_plane_detection {

HWY_EXPORT(computeAllTiles);

void runTileMomentsKernel(const ImageInput& input, TileMoments& tiles) {
  HWY_DYNAMIC_DISPATCH(computeAllTiles)(input, tiles);
}

}  // namespace dominant_plane_detection
#endif
