#include "doctor/image_trials.h"

#include <cmath>
#include <cstdio>

namespace dominant_plane_detection {
namespace {

/// [m] Tried in turn; beyond the last one no camera of the kind sees a floor.
constexpr double kRanges[] = {1.0, 2.0, 4.0, 6.0, 10.0};
constexpr std::size_t kFewest = 2;  // [#] images without a plane
/// Planes in more than one of so many images: then nothing keeps them away for good.
constexpr std::size_t kNearlyNone = 4;

/// Where tf knows the camera's height, a plane at another one is a ceiling or a table.
bool isAtExpectedHeight(const Detection& detection, const Prior& prior) {
  if (!prior.expected_height) return true;
  return std::abs(detection.distance - prior.expected_height->height) <=
         prior.expected_height->tolerance;
}

/// @return up of a camera that is turned by half a turn about its optical axis.
Eigen::Vector3d rolled(const Eigen::Vector3d& up) { return {-up.x(), -up.y(), up.z()}; }

const char* whereUpIsFrom(UpSource source) {
  switch (source) {
    case UpSource::kTf:
      return "tf has the camera upside down, or it looks at a ceiling alone. Correct the mount's "
             "roll in tf (mount_roll of pioneer.launch, or the robot's model)";
    case UpSource::kImu:
      return "the inertial sensor is not fixed to the camera as tf says, or the camera looks at a "
             "ceiling alone. Correct the transform between their frames, or set use_imu to false";
    default:
      return "the camera is mounted upside down, its driver turns the images, or it looks at a "
             "ceiling alone. Turn the images, or change the sign of expected_up_y";
  }
}

}  // namespace

ImageTrials::ImageTrials(const Parameters& parameters) : parameters_(parameters) {
  Trial upside_down;
  upside_down.upside_down = true;
  trials_.push_back(upside_down);
  for (const double range : kRanges) {
    if (!(range > parameters.range_max)) continue;
    Trial farther;
    farther.range_max = range;
    trials_.push_back(farther);
  }
}

bool ImageTrials::heals(const Trial& trial, const DepthView& depth, const CameraModel& camera,
                        const Prior& prior) const {
  Parameters parameters = parameters_;
  Prior changed = prior;
  changed.predicted_plane.reset();
  if (trial.range_max > 0.0) parameters.range_max = trial.range_max;
  if (trial.upside_down) {
    parameters.expected_up = rolled(parameters.expected_up);
    if (changed.expected_up) changed.expected_up = rolled(*changed.expected_up);
  }
  DominantPlaneDetector detector(parameters);
  const Detection& detection = detector.detect(depth, camera, changed);
  return detection.found() && isAtExpectedHeight(detection, prior);
}

void ImageTrials::add(const DepthView& depth, const CameraModel& camera, const Prior& prior,
                      const Detection& detection) {
  ++images_;
  if (detection.found()) return;
  ++failed_;
  reason_ = detection.reason;
  up_source_ = prior.up_source;
  for (Trial& trial : trials_) {
    if (heals(trial, depth, camera, prior)) ++trial.healed;
  }
}

Finding ImageTrials::describe(const Trial& trial) const {
  char text[700];
  char begin[400];
  std::snprintf(begin, sizeof(begin), "No plane in %zu of %zu images (%s)", failed_, images_,
                reason_.c_str());
  if (trial.upside_down) {
    std::snprintf(text, sizeof(text),
                  "%s, but with the camera upside down %zu of these have one: %s.", begin,
                  trial.healed, whereUpIsFrom(up_source_));
    return {Code::kUpsideDown, text};
  }
  std::snprintf(text, sizeof(text),
                "%s, but with range_max %g m instead of %g m %zu of these have one: the ground is "
                "farther away than what is trusted. Set range_max to %g.",
                begin, trial.range_max, parameters_.range_max, trial.healed, trial.range_max);
  return {Code::kRangeMax, text};
}

Findings ImageTrials::findings() const {
  if (failed_ < kFewest && failed_ < images_) return {};
  if (failed_ == 0 || kNearlyNone * planes() > images_) return {};
  // What heals more is the cause; of equals the first, which changes least.
  const Trial* best = nullptr;
  for (const Trial& trial : trials_) {
    if (2 * trial.healed <= failed_) continue;
    if (best == nullptr || trial.healed > best->healed) best = &trial;
  }
  if (best == nullptr) return {};
  return {describe(*best)};
}

}  // namespace dominant_plane_detection
