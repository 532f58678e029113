#include "ros/plane_prior.h"

#include <ros/console.h>

namespace dominant_plane_detection {
namespace {

const char* nameOf(UpSource source) {
  switch (source) {
    case UpSource::kTf:
      return "tf";
    case UpSource::kImu:
      return "gravity";
    case UpSource::kFixed:
      return "expected_up";
    case UpSource::kNone:
      break;
  }
  return "none";
}

}  // namespace

PlanePrior::PlanePrior(const ros::NodeHandle& node, const NodeParameters& parameters,
                       RobotFrames& frames)
    : parameters_(parameters),
      frames_(frames),
      gravity_(node, frames),
      track_(parameters.smoothing_time),
      mount_(parameters.base_frame) {}

void PlanePrior::subscribe() {
  if (!parameters_.base_frame.empty()) frames_.listen();
  if (parameters_.use_imu) gravity_.subscribe();
}

/// What is usual of the mount stays.
void PlanePrior::unsubscribe() {
  gravity_.unsubscribe();
  frames_.rest();
  last_ = std_msgs::Header();
  track_.reset();
  forget();
}

void PlanePrior::forget() {
  choice_ = UpChoice();
  remark_ = Remark();
  mount_.forget();
  status_ = Status();
}

/// A bag that begins again, or another camera.
void PlanePrior::beginAnewAfterJumps(const std_msgs::Header& header) {
  const bool first = last_.frame_id.empty();
  const bool other_camera = !first && header.frame_id != last_.frame_id;
  if (other_camera) mount_.reset();
  if (other_camera || (!first && header.stamp < last_.stamp)) {
    track_.reset();
    gravity_.reset();
    forget();
  }
  last_ = header;
}

UpChoice::Candidates PlanePrior::candidates(const std_msgs::Header& header) {
  UpChoice::Candidates candidates;
  status_.tf_height = 0.0;
  camera_.reset();
  height_.reset();
  // What the plane itself tells tf is no prior of it.
  const bool by_tf = !parameters_.base_frame.empty() && parameters_.publish_tf != TfOutput::kBase;
  if (by_tf) {
    const auto pose = frames_.pose(parameters_.base_frame, header.frame_id, header.stamp);
    status_.tf.add(pose);
    candidates.tf_problem = pose.problem;
    if (pose.transform) {
      const MountedGround ground = mountedGround(*pose.transform);
      candidates.tf = ground.up;
      height_ = ground.height;
      status_.tf_height = pose.transform->translation().z();
      if (pose.exact) camera_ = pose.transform;
    }
  }
  if (parameters_.use_imu) {
    candidates.gravity = gravity_.up(header.frame_id, header.stamp);
    candidates.gravity_problem = gravity_.problem();
  }
  status_.tf_problem = candidates.tf_problem;
  return candidates;
}

Prior PlanePrior::of(const DetectionInputs::Frame& frame) {
  beginAnewAfterJumps(frame.header);
  const double stamp = frame.header.stamp.toSec();
  const auto known = choice_.choose(stamp, candidates(frame.header));
  Prior prior;
  if (known) {
    prior.expected_up = known->up.direction;
    prior.up_source = known->source;
    prior.up_error = known->up.error;
  }
  const bool by_tf = known && known->source == UpSource::kTf;
  if (!by_tf) {
    camera_.reset();
    height_.reset();
  }
  prior.expected_height = height_;
  if (parameters_.tracking) {
    PlaneTrack::Motion motion{camera_, std::nullopt};
    if (track_.stamp()) motion.turn = gravity_.turn(frame.header.frame_id, *track_.stamp(), stamp);
    prior.predicted_plane = track_.predict(stamp, motion);
  }
  status_.up_source = nameOf(known ? known->source : UpSource::kFixed);
  report(status_.remark, lasting(stamp, choice_.remark()));
  return prior;
}

/// @return a remark that has lasted for a second: at the start everything comes one after the
/// other. It is over after a second without it, so that what comes and goes is told as well.
std::string PlanePrior::lasting(double stamp, const std::string& text) {
  constexpr double kPatience = 1.0;  // [s]
  if (!text.empty()) {
    if (remark_.text.empty()) remark_.since = stamp;
    remark_.text = text;
    remark_.last = stamp;
  } else if (!(stamp - remark_.last < kPatience)) {
    remark_ = Remark();
  }
  return stamp - remark_.since >= kPatience ? remark_.text : "";
}

void PlanePrior::add(const DetectionInputs::Frame& frame, const Detection& detection) {
  track_.add(frame.header.stamp.toSec(), detection, camera_);
  // Only tf of the image's very time says something about the mount.
  mount_.add(frame.header.stamp.toSec(), detection, camera_, height_);
  report(status_.mount, mount_.text());
  status_.mount_is_height = mount_.isOfHeight();
  status_.heights = mount_.heights();
  status_.height = detection.found() ? detection.distance : 0.0;
}

/// Numbers change from image to image, and are told once: the log has what begins.
void PlanePrior::report(std::string& said, const std::string& now) {
  if (said.empty() && !now.empty()) ROS_WARN_STREAM(now);
  said = now;
}

}  // namespace dominant_plane_detection
