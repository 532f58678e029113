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

void PlanePrior::unsubscribe() {
  gravity_.unsubscribe();
  last_ = std_msgs::Header();
  track_.reset();
  mount_check_.reset();
  remark_since_.reset();
  elsewhere_ = 0;
  status_ = Status();
}

/// A bag that begins again, or another camera.
void PlanePrior::beginAnewAfterJumps(const std_msgs::Header& header) {
  const bool first = last_.frame_id.empty();
  if (!first && (header.frame_id != last_.frame_id || header.stamp < last_.stamp)) {
    track_.reset();
    mount_check_.reset();
    gravity_.reset();
    choice_ = UpChoice();
    elsewhere_ = 0;
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
/// other.
std::string PlanePrior::lasting(double stamp, const std::string& remark) {
  constexpr double kPatience = 1.0;  // [s]
  if (remark.empty()) {
    remark_since_.reset();
    return remark;
  }
  if (!remark_since_ || stamp < *remark_since_) remark_since_ = stamp;
  return stamp - *remark_since_ >= kPatience ? remark : "";
}

void PlanePrior::add(const DetectionInputs::Frame& frame, const Detection& detection) {
  track_.add(frame.header.stamp.toSec(), detection, camera_);
  compareWithTf(frame.header, detection);
}

void PlanePrior::compareWithTf(const std_msgs::Header& header, const Detection& detection) {
  if (!height_ || !detection.found()) return;
  const double off = detection.distance - height_->height;
  if (std::abs(off) > height_->tolerance) {
    if (++elsewhere_ < kManyElsewhere) return;
    char text[200];
    std::snprintf(
        text, sizeof(text),
        "The plane is %.2f m %s where tf has the ground of %s: it is another level, or the "
        "mount is not where tf has it.",
        std::abs(off), off < 0.0 ? "above" : "below", parameters_.base_frame.c_str());
    report(status_.mount, text);
    return;
  }
  elsewhere_ = 0;
  if (camera_) mount_check_.add(header.stamp.toSec(), detection, *camera_);
  report(status_.mount, mount_check_.moved() ? mount_check_.moved()->text() : "");
}

/// Numbers change from image to image, and are told once: the log has what begins.
void PlanePrior::report(std::string& said, const std::string& now) {
  if (said.empty() && !now.empty()) ROS_WARN_STREAM(now);
  said = now;
}

}  // namespace dominant_plane_detection
