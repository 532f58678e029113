// The rule of labels in vectors; part of the kernels that hold pixels against a plane, once for
// each instruction set.
#if defined(DPD_LABEL_RULE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DPD_LABEL_RULE_INL
#undef DPD_LABEL_RULE_INL
#else
#define DPD_LABEL_RULE_INL
#endif

#include <hwy/highway.h>

#include <limits>

#include "core/label_rule.h"
#include "core/pixel_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace dominant_plane_detection {
namespace HWY_NAMESPACE {

/// Made once: labels are bytes, which may alias anything, so the compiler would load the rule again
/// after each of them.
class VectorRule {
 public:
  HWY_INLINE explicit VectorRule(const LabelRule& rule) {
    const Floats d;
    normal_x_ = hn::Set(d, rule.normal[0]);
    normal_y_ = hn::Set(d, rule.normal[1]);
    normal_z_ = hn::Set(d, rule.normal[2]);
    distance_ = hn::Set(d, rule.distance);
    band_ = hn::Set(d, rule.band);
    band_z2_ = hn::Set(d, rule.band_z2);
    narrow_ = hn::Set(d, rule.narrow);
    narrow_z2_ = hn::Set(d, rule.narrow_z2);
  }

  /// @return [m] over the plane; not a number without a reading.
  HWY_INLINE Vector height(const Points& points) const { return heightAt(points, points.z); }
  /// @return [m]
  HWY_INLINE Vector band(const Points& points) const {
    return hn::MulAdd(hn::Mul(points.z, points.z), band_z2_, band_);
  }
  /// @return [m]
  HWY_INLINE Vector narrowBand(const Points& points) const {
    return hn::MulAdd(hn::Mul(points.z, points.z), narrow_z2_, narrow_);
  }
  /// @param height, band [m] of the points.
  /// @return whether the reading, beyond the range, is below twice the band, and the plane is not
  /// beyond the range.
  HWY_INLINE hn::Mask<Floats> isBelowFarthest(const Points& points, Vector height, Vector band,
                                              float range_max) const {
    const Floats d;
    const auto farthest = hn::Set(d, range_max);
    const auto endless = hn::Set(d, std::numeric_limits<float>::infinity());
    const auto beyond = hn::And(hn::Gt(points.z, farthest), hn::Lt(points.z, endless));
    const auto plane_within = hn::Le(heightAt(points, farthest), hn::Zero(d));
    const auto below = hn::Lt(height, hn::Mul(hn::Set(d, -2.0F), band));
    return hn::And(beyond, hn::And(plane_within, below));
  }

 private:
  /// @return [m] the height over the plane where a point's ray has a depth [m].
  HWY_INLINE Vector heightAt(const Points& points, Vector z) const {
    const auto along_ray =
        hn::MulAdd(normal_x_, points.ray_x, hn::MulAdd(normal_y_, points.ray_y, normal_z_));
    return hn::MulAdd(z, along_ray, distance_);
  }

  Vector normal_x_, normal_y_, normal_z_, distance_, band_, band_z2_, narrow_, narrow_z2_;
};

}  // namespace HWY_NAMESPACE
}  // namespace dominant_plane_detection
HWY_AFTER_NAMESPACE();

#endif
