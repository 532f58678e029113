#include "doctor/image_rules.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace dominant_plane_detection {
namespace {

/// A depth image in another unit, in memory of its own where it has to be.
class ScaledDepth {
 public:
  ScaledDepth(const DepthView& depth, double factor) : view_(depth) {
    if (depth.type == DepthView::Type::kUint16) {
      view_.metres_per_unit *= static_cast<float>(factor);
      return;
    }
    for (int v = 0; v < depth.height; ++v) {
      const float* const row = depth.row<float>(v);
      for (int u = 0; u < depth.width; ++u) {
        pixels_.push_back(static_cast<float>(factor) * row[u]);
      }
    }
    view_ = DepthView(pixels_.data(), depth.width, depth.height);
  }
  const DepthView& view() const { return view_; }

 private:
  std::vector<float> pixels_;
  DepthView view_;
};

/// [-] How far the middle of the readings is from that of what a camera sees, in powers of e.
double oddness(const DepthSpread& spread) {
  const double middle = std::sqrt(0.3 * 10.0);  // [m]
  return std::abs(std::log(spread.median / middle));
}

}  // namespace

std::optional<Finding> findMirrored(const ShadowSides& sides) {
  /// [#] Some ten rows at each edge of a dozen images.
  constexpr std::size_t kMany = 200;
  /// [-] Real cameras have eight and more gaps on the right side for one on the wrong one; depth
  /// that was registered to a colour camera between the two has twice as many, and is not judged.
  constexpr std::size_t kNearlyAll = 4;
  if (sides.right < kMany || sides.right < kNearlyAll * sides.left) return std::nullopt;
  char text[500];
  std::snprintf(text, sizeof(text),
                "Images are mirrored: of the gaps that near things leave in the rows behind them, "
                "%zu are on the right and %zu on the left, where a Kinect, an Xtion or a RealSense "
                "has them. Left and right of all that is seen are exchanged. Switch the driver's "
                "mirroring off (setMirroringEnabled, depth_mirror), or turn cv::flip off.",
                sides.right, sides.left);
  return Finding{Code::kMirrored, text};
}

void ScaleTrials::add(const DepthView& depth, const CameraModel& camera, const Prior& prior) {
  ++images_;
  const DepthSpread spread = spreadOf(depth);
  if (isPlausible(spread)) return;
  ++implausible_;
  if (isImpossible(spread)) ++impossible_;
  spread_ = spread;
  for (std::size_t i = 0; i < kDepthUnits.size(); ++i) {
    const double factor = kDepthUnits[i].factor;
    if (!isPlausible(spread.scaled(factor))) continue;
    ++counts_[i].plausible;
    Prior as_it_is = prior;
    as_it_is.predicted_plane.reset();
    DominantPlaneDetector detector(parameters_);
    if (detector.detect(ScaledDepth(depth, factor).view(), camera, as_it_is).found()) {
      ++counts_[i].planes;
    }
  }
}

std::optional<Finding> ScaleTrials::finding() const {
  if (implausible_ == 0 || 2 * implausible_ <= images_) return std::nullopt;
  const bool impossible = 2 * impossible_ > images_;
  const DepthUnit* best = nullptr;
  std::size_t planes = 0;
  for (std::size_t i = 0; i < kDepthUnits.size(); ++i) {
    const bool proved = 2 * counts_[i].planes > implausible_;
    const bool only_plausible = impossible && 2 * counts_[i].plausible > implausible_;
    if (!proved && !only_plausible) continue;
    const bool better = best == nullptr || oddness(spread_.scaled(kDepthUnits[i].factor)) <
                                               oddness(spread_.scaled(best->factor));
    if (!better) continue;
    best = &kDepthUnits[i];
    planes = counts_[i].planes;
  }
  if (best == nullptr) return std::nullopt;
  char text[800];
  std::snprintf(text, sizeof(text),
                "Readings are %.3g m (10 %%), %.3g m (median) and %.3g m (95 %%), which no camera "
                "of this kind sees (0.3 to 10 m), in %zu of %zu images. Multiplied by %g they are "
                "plausible, and %zu of these show a plane: images seem to be %s. Have the driver "
                "publish 16UC1 in millimetres or 32FC1 in metres, or set its z_scale; for PNG "
                "files give --depth-scale.",
                spread_.near, spread_.median, spread_.far, implausible_, images_, best->factor,
                planes, best->meaning);
  return Finding{Code::kDepthScale, text};
}

const Detection& ImageStudy::add(const DepthView& depth, const CameraModel& camera,
                                 const Prior& prior) {
  const Detection& detection = detector_.detect(depth, camera, prior);
  trials_.add(depth, camera, prior, detection);
  scales_.add(depth, camera, prior);
  shadows_.add(shadowSides(depth, camera));
  return detection;
}

Findings ImageStudy::findingsWithoutTrials() const {
  if (const auto scale = scales_.finding()) return {*scale};
  if (const auto mirrored = findMirrored(shadows_)) return {*mirrored};
  return {};
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
