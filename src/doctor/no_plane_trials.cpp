#include "doctor/no_plane_trials.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dominant_plane_detection {
namespace {

constexpr double kPeriod = 1.0;     // [s] between trials, at the least
constexpr double kRest = 20.0;      // [-] times as long as the last ones took
constexpr std::size_t kFewest = 2;  // [#] images that tell a cause

/// A trial asks whether there is a plane with another up, range or unit, which both algorithms find
/// where it is; point by point each takes up to a second.
Parameters byGrid(Parameters parameters) {
  parameters.algorithm = Algorithm::kGrid;
  return parameters;
}

}  // namespace

NoPlaneTrials::NoPlaneTrials(const Parameters& parameters, Clock clock)
    : clock_(std::move(clock)),
      is_grid_(parameters.algorithm == Algorithm::kGrid),
      parameters_(byGrid(parameters)),
      trials_(parameters_),
      scales_(parameters_) {}

double NoPlaneTrials::steadyNow() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

void NoPlaneTrials::add(const DepthView& depth, const CameraModel& camera, const Prior& prior,
                        const Detection& detection) {
  if (detection.found()) {
    if (last_) {
      trials_ = ImageTrials(parameters_);
      scales_ = ScaleTrials(parameters_);
      rounds_ = 0;
      last_.reset();
    }
    return;
  }
  const double now = clock_();
  if (!last_) last_ = now;
  if (now - *last_ < std::max(kPeriod, kRest * took_)) return;
  tryImage(depth, camera, prior, detection);
  last_ = clock_();
  took_ = *last_ - now;
}

void NoPlaneTrials::tryImage(const DepthView& depth, const CameraModel& camera, const Prior& prior,
                             const Detection& detection) {
  // What the grid sees as it is needs no cure that the trials know.
  if (!is_grid_ && DominantPlaneDetector(parameters_).detect(depth, camera, prior).found()) return;
  ++rounds_;
  trials_.add(depth, camera, prior, detection);
  scales_.add(depth, camera, prior, detection);
}

std::optional<Finding> NoPlaneTrials::cause() const {
  if (rounds_ < kFewest) return std::nullopt;
  if (const auto scale = scales_.finding()) return scale;
  const Findings findings = trials_.findings();
  return findings.empty() ? std::nullopt : std::optional<Finding>(findings.front());
}

}  // namespace dominant_plane_detection
