#include "core/plane_refinement_kernel.h"

// Compiled once for each instruction set, see tile_moments_kernel.cpp.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/plane_refinement_kernel.cpp"
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

PlaneResiduals sumResiduals(const TileMoments& t, const TileRule& rule, const PlaneFrame& frame,
                            std::vector<std::uint8_t>& on_plane) {
  const Floats d;
  const hn::Rebind<std::int32_t, Floats> wide;
  const hn::Rebind<std::uint8_t, Floats> bytes;
  const Vector3 origin = Vector3::all(frame.origin);
  const Vector3 a = Vector3::all(frame.axes.col(0)), b = Vector3::all(frame.axes.col(1)),
                n = Vector3::all(frame.axes.col(2));
  const auto min_count = hn::Set(d, rule.min_count);
  const auto four = hn::Set(d, 4.0F);
  auto points = hn::Zero(d), s = points, s_a = points, s_b = points, s_h = points;
  auto s_aa = points, s_ab = points, s_bb = points, s_ah = points, s_bh = points;
  for (std::size_t i = 0; i < t.count.size(); i += hn::Lanes(d)) {
    const auto load = [&](const std::vector<float>& values) { return hn::LoadU(d, &values[i]); };
    const Vector3 c{hn::Sub(load(t.x), origin.x), hn::Sub(load(t.y), origin.y),
                    hn::Sub(load(t.z), origin.z)};
    const auto xy = load(t.xy), xz = load(t.xz), yz = load(t.yz);
    // Scatter times normal: how the heights within the tile go with x, y and z.
    const Vector3 scatter_n{n.dot({load(t.xx), xy, xz}), n.dot({xy, load(t.yy), yz}),
                            n.dot({xz, yz, load(t.zz)})};
    const auto h = n.dot(c);
    const auto variance = n.dot(scatter_n);
    const auto count = load(t.count);
    const auto rest = hn::Sub(load(rule.gamma), hn::Abs(h));
    const auto on = hn::And(hn::And(hn::Ge(count, min_count), hn::Gt(rest, hn::Zero(d))),
                            hn::Lt(hn::Mul(four, variance), hn::Mul(rest, rest)));
    const auto k = hn::IfThenElseZero(on, count);
    const auto flag = hn::IfThenElseZero(hn::RebindMask(wide, on), hn::Set(wide, 1));
    hn::StoreU(hn::DemoteTo(bytes, flag), bytes, &on_plane[i]);

    const auto w = hn::Mul(k, load(rule.weight));
    const auto alpha = a.dot(c), beta = b.dot(c);
    const auto w_alpha = hn::Mul(w, alpha), w_beta = hn::Mul(w, beta);
    points = hn::Add(points, k);
    s = hn::Add(s, w);
    s_a = hn::Add(s_a, w_alpha);
    s_b = hn::Add(s_b, w_beta);
    s_h = hn::MulAdd(w, h, s_h);
    s_aa = hn::MulAdd(w_alpha, alpha, s_aa);
    s_ab = hn::MulAdd(w_alpha, beta, s_ab);
    s_bb = hn::MulAdd(w_beta, beta, s_bb);
    s_ah = hn::MulAdd(w, hn::MulAdd(alpha, h, a.dot(scatter_n)), s_ah);
    s_bh = hn::MulAdd(w, hn::MulAdd(beta, h, b.dot(scatter_n)), s_bh);
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

HWY_EXPORT(sumResiduals);

PlaneResiduals runPlaneRefinementKernel(const TileMoments& tiles, const TileRule& rule,
                                        const PlaneFrame& frame,
                                        std::vector<std::uint8_t>& on_plane) {
  return HWY_DYNAMIC_DISPATCH(sumResiduals)(tiles, rule, frame, on_plane);
}

}  // namespace dominant_plane_detection
#endif
