#include "doctor/image_rules.h"

#include <cstdio>

namespace dominant_plane_detection {

std::optional<Finding> findMirrored(const ShadowSides& sides) {
  /// [#] Some ten rows at each edge of a dozen images.
  constexpr std::size_t kMany = 200;
  /// [-] Real cameras have eight and more gaps on the right side for one on the wrong one; depth
  /// that was registered to a colour camera between the two has twice as many, and is not judged.
  constexpr std::size_t kNearlyAll = 4;
  if (sides.right < kMany || sides.right < kNearlyAll * sides.left) return std::nullopt;
  char text[500];
  std::snprintf(text, sizeof(text),
                "Images are mirrored, or turned by half a turn: of the gaps that near things leave "
                "in the rows behind them, %zu are on the right and %zu on the left, where a "
                "Kinect, an Xtion or a RealSense has them. Left and right of all that is seen are "
                "exchanged. Switch the driver's "
                "mirroring off, and whatever flips or turns its images.",
                sides.right, sides.left);
  return Finding{Code::kMirrored, text};
}

const Detection& ImageStudy::add(const DepthView& depth, const CameraModel& camera,
                                 const Prior& prior) {
  const Detection& detection = detector_.detect(depth, camera, prior);
  ++images_;
  if (detection.found()) ++planes_;
  if (tries_) trials_.add(depth, camera, prior, detection);
  scales_.add(depth, camera, prior, detection);
  shadows_.add(shadowSides(depth, camera));
  return detection;
}

/// One cause for one symptom: in a wrong unit the ground is out of range, too, and in an image that
/// is turned by half a turn gaps are on the other side.
Findings ImageStudy::findings() const {
  if (const auto scale = scales_.finding()) return {*scale};
  Findings findings = trials_.findings();
  if (!hasCode(findings, Code::kUpsideDown)) {
    if (const auto mirrored = findMirrored(shadows_)) findings.push_back(*mirrored);
  }
  return findings;
}

}  // namespace dominant_plane_detection
