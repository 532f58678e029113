#include "doctor/scale_trials.h"

#include <cmath>
#include <cstdio>
#include <vector>

#include "dominant_plane_detection/dominant_plane_detector.h"

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

std::string asText(double factor) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g", factor);
  return text;
}

}  // namespace

void ScaleTrials::add(const DepthView& depth, const CameraModel& camera, const Prior& prior,
                      const Detection& detection) {
  ++images_;
  const DepthSpread spread = spreadOf(depth);
  const bool impossible = isImpossible(spread);
  // What shows a plane as it is, is of a hall, or has a gripper before it.
  const bool may_be = detection.found() && !impossible && !isFarInSteps(spread);
  if (isPlausible(spread) || may_be) return;
  ++implausible_;
  if (impossible) ++impossible_;
  spread_ = spread;
  Prior as_it_is = prior;
  as_it_is.predicted_plane.reset();
  for (std::size_t i = 0; i < kDepthUnits.size(); ++i) {
    const double factor = kDepthUnits[i].factor;
    if (!isPlausible(spread.scaled(factor))) continue;
    ++counts_[i].plausible;
    DominantPlaneDetector detector(parameters_);
    const ScaledDepth scaled(depth, factor);
    if (detector.detect(scaled.view(), camera, as_it_is).found()) ++counts_[i].planes;
  }
}

bool ScaleTrials::explains(std::size_t unit) const {
  if (2 * counts_[unit].planes > implausible_) return true;
  return 2 * impossible_ > images_ && 2 * counts_[unit].plausible > implausible_;
}

/// @return [-] How far the middle of the readings is from that of what a camera sees, in powers of
/// e.
double ScaleTrials::oddness(std::size_t unit) const {
  const double middle = std::sqrt(0.3 * 10.0);  // [m]
  return std::abs(std::log(kDepthUnits[unit].factor * spread_.median / middle));
}

/// Where two units explain it images alone do not tell which.
std::string ScaleTrials::factors(std::size_t best) const {
  std::string text = asText(kDepthUnits[best].factor);
  for (std::size_t i = 0; i < kDepthUnits.size(); ++i) {
    if (i != best && explains(i)) text += " (or " + asText(kDepthUnits[i].factor) + ")";
  }
  return text;
}

std::optional<Finding> ScaleTrials::finding() const {
  if (implausible_ == 0 || 2 * implausible_ <= images_) return std::nullopt;
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < kDepthUnits.size(); ++i) {
    if (explains(i) && (!best || oddness(i) < oddness(*best))) best = i;
  }
  if (!best) return std::nullopt;
  char text[800];
  std::snprintf(text, sizeof(text),
                "Readings are %.3g m (10 %%), %.3g m (median) and %.3g m (95 %%) in %zu of %zu "
                "images, which no camera of this kind sees (0.3 to 10 m). Multiplied by %s they "
                "are plausible, and %zu of these show a plane: images seem to be %s. Have the "
                "driver publish 16UC1 in millimetres or 32FC1 in metres, or set its z_scale; for "
                "PNG files give --depth-scale.",
                spread_.near, spread_.median, spread_.far, implausible_, images_,
                factors(*best).c_str(), counts_[*best].planes, kDepthUnits[*best].meaning);
  return Finding{Code::kDepthScale, text};
}

}  // namespace dominant_plane_detection
