#include "doctor/no_plane_trials.h"

namespace dominant_plane_detection {

void NoPlaneTrials::add(double now, const DepthView& depth, const CameraModel& camera,
                        const Prior& prior, const Detection& detection) {
  constexpr double kPeriod = 1.0;  // [s]
  if (detection.found()) {
    if (last_) *this = NoPlaneTrials(parameters_);
    return;
  }
  if (!last_) last_ = now;
  if (now - *last_ < kPeriod) return;
  last_ = now;
  trials_.add(depth, camera, prior, detection);
  scales_.add(depth, camera, prior);
}

std::optional<Finding> NoPlaneTrials::cause() const {
  if (const auto scale = scales_.finding()) return scale;
  const Findings findings = trials_.findings();
  return findings.empty() ? std::nullopt : std::optional<Finding>(findings.front());
}

}  // namespace dominant_plane_detection
