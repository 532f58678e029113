#include "core/tile_plane_kernel.h"

// Compiled once for each instruction set, see tile_moments_kernel.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/tile_plane_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/pixel_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dominant_plane_detection {
namespace HWY_NAMESPACE {

struct Vector3 {
  Vector x, y, z;

  static HWY_INLINE Vector3 all(const Eigen::Vector3f& v) {
    const Floats d;
    return {hn::Set(d, v.x()), hn::Set(d, v.y()), hn::Set(d, v.z())};
  }
  HWY_INLINE Vector dot(const Vector3& o) const {
    return hn::MulAdd(x, o.x, hn::MulAdd(y, o.y, hn::Mul(z, o.z)));
  }
};

/// The frame in vectors, broadcast once.
struct VectorFrame {
  Vector3 origin, a, b, n;

  explicit VectorFrame(const PlaneFrame& frame)
      : origin(Vector3::all(frame.origin)),
        a(Vector3::all(frame.axes.col(0))),
        b(Vector3::all(frame.axes.col(1))),
        n(Vector3::all(frame.axes.col(2))) {}
};

/// What is known of neighbouring tiles and a plane.
struct TileHeights {
  Vector3 centre;     ///< [m] from the frame's origin
  Vector3 scatter_n;  ///< [m^2] scatter times normal: how the heights go with x, y and z
  Vector count;
  Vector height;    ///< [m]
  Vector variance;  ///< [m^2] of the heights within the tile
  hn::Mask<Floats> touches;
  hn::Mask<Floats> on_plane;
};

/// @return [m^2] the part of the variance of the heights that goes with x and y. These hardly
/// depend on the readings, so that noise, which is no slope, leaves only 2 / count of its variance
/// here.
HWY_INLINE Vector slopeVariance(const Vector3& scatter_n, Vector xx, Vector xy, Vector yy) {
  const Floats d;
  const auto determinant = hn::NegMulAdd(xy, xy, hn::Mul(xx, yy));
  const auto explained =
      hn::MulAdd(hn::Mul(scatter_n.x, scatter_n.x), yy,
                 hn::NegMulAdd(hn::Mul(hn::Set(d, 2.0F), xy), hn::Mul(scatter_n.x, scatter_n.y),
                               hn::Mul(hn::Mul(scatter_n.y, scatter_n.y), xx)));
  // Readings in one row or column tell no slope.
  const auto known = hn::Gt(determinant, hn::Mul(hn::Set(d, 1e-4F), hn::Mul(xx, yy)));
  return hn::IfThenElseZero(
      known, hn::Div(explained, hn::IfThenElse(known, determinant, hn::Set(d, 1.0F))));
}

HWY_INLINE TileHeights tileHeights(const TileMoments& t, const TileLimits& limits,
                                   const VectorFrame& frame, Vector level, std::size_t i) {
  const Floats d;
  const auto load = [&](const std::vector<float>& values) { return hn::LoadU(d, &values[i]); };
  TileHeights tile;
  tile.centre = {hn::Sub(load(t.x), frame.origin.x), hn::Sub(load(t.y), frame.origin.y),
                 hn::Sub(load(t.z), frame.origin.z)};
  const Vector3& n = frame.n;
  const auto xx = load(t.xx), xy = load(t.xy), xz = load(t.xz), yy = load(t.yy), yz = load(t.yz);
  tile.scatter_n = {n.dot({xx, xy, xz}), n.dot({xy, yy, yz}), n.dot({xz, yz, load(t.zz)})};
  tile.count = load(t.count);
  tile.height = n.dot(tile.centre);
  tile.variance = hn::Max(n.dot(tile.scatter_n), hn::Zero(d));
  const auto inverse_sigma = load(limits.inverse_sigma);
  const auto distance = hn::Abs(tile.height);
  const auto rest = hn::Sub(load(limits.gamma), distance);
  const auto two_sigma =
      hn::And(hn::Gt(rest, hn::Zero(d)),
              hn::Lt(hn::Mul(hn::Set(d, 4.0F), tile.variance), hn::Mul(rest, rest)));
  const auto near = hn::Lt(hn::Mul(distance, inverse_sigma), level);
  const auto slope =
      hn::Mul(slopeVariance(tile.scatter_n, xx, xy, yy), hn::Mul(inverse_sigma, inverse_sigma));
  const auto flat = hn::Lt(slope, hn::Set(d, PlaneTest::kMaxSlope * PlaneTest::kMaxSlope));
  const auto filled = hn::Ge(tile.count, hn::Set(d, kMinReadings));
  tile.touches = hn::And(filled, hn::And(hn::Gt(rest, hn::Zero(d)), flat));
  tile.on_plane = hn::And(tile.touches, hn::And(two_sigma, near));
  return tile;
}

void judgeTiles(const TileMoments& t, const TileLimits& limits, const PlaneTest& test,
                std::size_t begin, std::size_t end, TileVerdicts& verdicts) {
  const Floats d;
  const hn::Rebind<std::int32_t, Floats> wide;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  const VectorFrame frame(test.frame);
  const auto level = hn::Set(d, test.level);
  const auto constant = [&](TileVerdict verdict) {
    return hn::Set(wide, static_cast<std::int32_t>(verdict));
  };
  for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
    const TileHeights tile = tileHeights(t, limits, frame, level, i);
    const auto close =
        hn::IfThenElse(hn::RebindMask(wide, tile.on_plane), constant(TileVerdict::kOnPlane),
                       constant(TileVerdict::kTouches));
    const auto verdict = hn::IfThenElseZero(hn::RebindMask(wide, tile.touches), close);
    hn::StoreU(hn::DemoteTo(bytes, verdict), bytes,
               reinterpret_cast<std::uint8_t*>(&verdicts.verdict[i]));
    hn::StoreU(tile.height, d, &verdicts.height[i]);
    hn::StoreU(hn::MulAdd(tile.height, tile.height, tile.variance), d, &verdicts.mean_square[i]);
  }
}

PlaneResiduals sumResiduals(const TileMoments& t, const TileLimits& limits, const PlaneTest& test,
                            float width, const std::vector<std::uint8_t>& members) {
  const Floats d;
  const hn::Rebind<std::int32_t, Floats> wide;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  const VectorFrame frame(test.frame);
  const auto level = hn::Set(d, test.level);
  const auto inverse_width = hn::Set(d, 1.0F / width);
  const auto one = hn::Set(d, 1.0F);
  auto points = hn::Zero(d), s = points, s_a = points, s_b = points, s_h = points;
  auto s_aa = points, s_ab = points, s_bb = points, s_ah = points, s_bh = points;
  for (std::size_t i = 0; i < t.count.size(); i += hn::Lanes(d)) {
    const auto member = hn::Ne(hn::PromoteTo(wide, hn::LoadU(bytes, &members[i])), hn::Zero(wide));
    if (hn::AllFalse(wide, member)) continue;
    const TileHeights tile = tileHeights(t, limits, frame, level, i);
    const auto used = hn::And(tile.on_plane, hn::RebindMask(d, member));
    const auto k = hn::IfThenElseZero(used, tile.count);
    const auto inverse_sigma = hn::LoadU(d, &limits.inverse_sigma[i]);
    const auto off = hn::Mul(hn::Mul(tile.height, inverse_sigma), inverse_width);
    const auto robust = hn::MulAdd(off, off, one);
    const auto w = hn::Mul(hn::Mul(k, hn::Mul(inverse_sigma, inverse_sigma)),
                           hn::Div(one, hn::Mul(robust, robust)));
    const auto alpha = frame.a.dot(tile.centre), beta = frame.b.dot(tile.centre);
    const auto w_alpha = hn::Mul(w, alpha), w_beta = hn::Mul(w, beta);
    points = hn::Add(points, k);
    s = hn::Add(s, w);
    s_a = hn::Add(s_a, w_alpha);
    s_b = hn::Add(s_b, w_beta);
    s_h = hn::MulAdd(w, tile.height, s_h);
    s_aa = hn::MulAdd(w_alpha, alpha, s_aa);
    s_ab = hn::MulAdd(w_alpha, beta, s_ab);
    s_bb = hn::MulAdd(w_beta, beta, s_bb);
    s_ah = hn::MulAdd(w, hn::MulAdd(alpha, tile.height, frame.a.dot(tile.scatter_n)), s_ah);
    s_bh = hn::MulAdd(w, hn::MulAdd(beta, tile.height, frame.b.dot(tile.scatter_n)), s_bh);
  }
  const auto total = [&](Vector v) {
    return static_cast<double>(hn::GetLane(hn::SumOfLanes(d, v)));
  };
  PlaneResiduals residuals;
  residuals.normal_matrix << total(s_aa), total(s_ab), total(s_a),  //
      total(s_ab), total(s_bb), total(s_b),                         //
      total(s_a), total(s_b), total(s);
  residuals.right << total(s_ah), total(s_bh), total(s_h);
  residuals.points = static_cast<std::size_t>(total(points));
  return residuals;
}

}  // namespace HWY_NAMESPACE
}  // namespace dominant_plane_detection
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace dominant_plane_detection {

HWY_EXPORT(judgeTiles);
HWY_EXPORT(sumResiduals);

void runTilePlaneKernel(const TileMoments& tiles, const TileLimits& limits, const PlaneTest& test,
                        std::size_t begin, std::size_t end, TileVerdicts& verdicts) {
  HWY_DYNAMIC_DISPATCH(judgeTiles)(tiles, limits, test, begin, end, verdicts);
}

PlaneResiduals runResidualKernel(const TileMoments& tiles, const TileLimits& limits,
                                 const PlaneTest& test, float width,
                                 const std::vector<std::uint8_t>& members) {
  return HWY_DYNAMIC_DISPATCH(sumResiduals)(tiles, limits, test, width, members);
}

}  // namespace dominant_plane_detection
#endif
