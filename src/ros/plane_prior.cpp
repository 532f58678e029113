#include "ros/plane_prior.h"

#include <ros/console.h>

#include <cmath>
#include <cstdio>

namespace dominant_plane_detection {
namespace {

constexpr double kMountError =
    0.175;  // [rad] a mount is reported, not refused, that is off by less
/// Height by tf: of a floor that is uneven, and a mount that was knocked.
constexpr double kHeightError = 0.1;        // [m]
constexpr double kHeightErrorShare = 0.05;  // [-] of the height
constexpr int kManyElsewhere = 15;          // [#] images

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
      track_(parameters.smoothing_time) {}

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
  compared_.reset();
  elsewhere_ = 0;
  status_ = Status();
}

/// A bag that begins again, or another camera.
void PlanePrior::beginAnewAfterJumps(const std_msgs::Header& header) {
  const bool first = last_.frame_id.empty();
  const bool other_camera = !first && header.frame_id != last_.frame_id;
  if (other_camera) mount_check_.reset();
  if (other_camera || (!first && header.stamp < last_.stamp)) {
    track_.reset();
    gravity_.reset();
    forget();
  }
  last_ = header;
}

UpChoice::Candidates PlanePrior::candidates(const std_msgs::Header& header) {
  UpChoice::Candidates candidates;
  camera_.reset();
  height_.reset();
  // What the plane itself tells tf is no prior of it.
  const bool by_tf = !parameters_.base_frame.empty() && parameters_.publish_tf != TfOutput::kBase;
  if (by_tf) {
    const auto pose = frames_.pose(parameters_.base_frame, header.frame_id, header.stamp);
    candidates.tf_problem = pose.problem;
    if (pose.transform) {
      candidates.tf =
          Up{pose.transform->linear().transpose() * Eigen::Vector3d::UnitZ(), kMountError};
      const double height = pose.transform->translation().z();
      if (height > 0.0) {
        height_ = Prior::ExpectedHeight{height, kHeightError + kHeightErrorShare * height};
      }
      if (pose.exact) camera_ = pose.transform;
    }
  }
  if (parameters_.use_imu) {
    candidates.gravity = gravity_.up(header.frame_id, header.stamp);
    candidates.gravity_problem = gravity_.problem();
  }
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
  compareWithTf(frame.header, detection);
}

/// Only tf of the image's very time says something about the mount.
void PlanePrior::compareWithTf(const std_msgs::Header& header, const Detection& detection) {
  constexpr double kPatience = 1.0;  // [s]
  const double stamp = header.stamp.toSec();
  if (!camera_ || !height_ || !detection.found()) {
    if (compared_ && stamp - *compared_ < kPatience) return;
    report(status_.mount, "");
    elsewhere_ = 0;
    return;
  }
  compared_ = stamp;
  const double off = detection.distance - height_->height;
  elsewhere_ = std::abs(off) > height_->tolerance ? elsewhere_ + 1 : 0;
  if (elsewhere_ == 0) {
    mount_check_.add(stamp, detection, *camera_);
    report(status_.mount, mount_check_.moved() ? mount_check_.moved()->text() : "");
  } else if (elsewhere_ >= kManyElsewhere) {
    char text[200];
    std::snprintf(
        text, sizeof(text),
        "The plane is %.2f m %s where tf has the ground of %s: it is another level, or the "
        "mount is not where tf has it.",
        std::abs(off), off < 0.0 ? "above" : "below", parameters_.base_frame.c_str());
    report(status_.mount, text);
  }
}

/// Numbers change from image to image, and are told once: the log has what begins.
void PlanePrior::report(std::string& said, const std::string& now) {
  if (said.empty() && !now.empty()) ROS_WARN_STREAM(now);
  said = now;
}

}  // namespace dominant_plane_detection
