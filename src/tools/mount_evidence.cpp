#include "mount_evidence.h"

#include "calibration/median.h"

namespace dominant_plane_detection {
namespace {

constexpr std::size_t kLasting = 6;  // [#] images, as many as the mount is judged by

/// @return 0 of nothing.
double middle(const std::vector<double>& values) { return values.empty() ? 0.0 : median(values); }

}  // namespace

bool MountEvidence::wanted() const {
  return !parameters_.base_frame.empty() && parameters_.publish_tf != TfOutput::kBase;
}

Prior MountEvidence::priorOf(const std_msgs::Header& header) {
  Prior prior;
  camera_.reset();
  height_.reset();
  if (!wanted()) return prior;
  const Pose pose = findPose(frames_, parameters_.base_frame, header.frame_id, header.stamp);
  poses_.add(pose);
  if (!pose.transform) {
    problem_ = pose.problem;
    return prior;
  }
  const MountedGround ground = mountedGround(*pose.transform);
  height_ = ground.height;
  if (pose.exact) camera_ = pose.transform;
  prior.expected_up = ground.up.direction;
  prior.up_error = ground.up.error;
  prior.up_source = UpSource::kTf;
  prior.expected_height = height_;
  return prior;
}

void MountEvidence::add(const std_msgs::Header& header, const Detection& detection) {
  if (!wanted()) return;
  watch_.add(header.stamp.toSec(), detection, camera_, height_);
  off_ = watch_.text().empty() ? 0 : off_ + 1;
  if (!detection.found() || !height_) return;
  heights_.push_back(detection.distance);
  tf_heights_.push_back(height_->height);
}

RobotFacts MountEvidence::facts() const {
  RobotFacts facts;
  facts.base_frame = wanted() ? parameters_.base_frame : "";
  if (2 * poses_.missing > poses_.images) facts.tf_problem = problem_;
  facts.tf_is_late = 2 * poses_.late > poses_.missing;
  // A mount that moved is off until the end.
  if (off_ >= kLasting) facts.mount = watch_.text();
  facts.mount_is_height = watch_.isOfHeight();
  facts.planes_at_tf_height = watch_.heights().expected;
  facts.planes_elsewhere = watch_.heights().others;
  facts.height = middle(heights_);
  facts.tf_height = middle(tf_heights_);
  return facts;
}

}  // namespace dominant_plane_detection
