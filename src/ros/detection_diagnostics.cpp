#include "ros/detection_diagnostics.h"

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <algorithm>

#include "ros/diagnostic_keys.h"

namespace dominant_plane_detection {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kManyOvertaken = 0.2;  // [-] share of the images above which to warn

}  // namespace

DetectionDiagnostics::DetectionDiagnostics(const ros::NodeHandle& node,
                                           const ros::NodeHandle& private_node,
                                           const std::string& name)
    : begin_(ros::SteadyTime::now()), updater_(node, private_node, name) {
  updater_.setHardwareID("none");
  updater_.add("detection", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    summarise(status);
    addValues(status);
  });
}

void DetectionDiagnostics::count(const Detection& detection, double seconds) {
  ++period_.images;
  if (detection.found()) ++period_.planes;
  period_.sum_seconds += seconds;
  period_.most_seconds = std::max(period_.most_seconds, seconds);
  state_ = stateName(detection.state);
  reason_ = detection.reason;
}

void DetectionDiagnostics::countFailure(const std::string& error) {
  ++period_.failures;
  reason_ = error;
}

void DetectionDiagnostics::report(const Input& input) {
  const ros::SteadyTime now = ros::SteadyTime::now();
  length_ = (now - begin_).toSec();
  input_ = input;
  updater_.force_update();
  begin_ = now;
  reported_ = input.counts;
  period_ = Period();
}

double DetectionDiagnostics::rate() const {
  return length_ > 0.0 ? static_cast<double>(period_.images) / length_ : 0.0;
}

void DetectionDiagnostics::summarise(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::uint64_t refused = input_.counts.refused - reported_.refused;
  const std::uint64_t overtaken = input_.counts.overtaken - reported_.overtaken;
  const auto received = static_cast<double>(input_.counts.received - reported_.received);
  if (!input_.subscription_error.empty()) {
    status.summary(DiagnosticStatus::ERROR, "cannot subscribe: " + input_.subscription_error);
  } else if (!input_.subscribed) {
    status.summary(DiagnosticStatus::OK, "idle: nobody listens");
  } else if (input_.problem) {
    status.summary(DiagnosticStatus::ERROR, input_.problem->text);
  } else if (period_.failures > 0) {
    status.summary(DiagnosticStatus::ERROR, "cannot work on images: " + reason_);
  } else if (refused > 0) {
    status.summaryf(DiagnosticStatus::WARN, "dropped %lu images. %s", refused,
                    input_.counts.refusal.text.c_str());
  } else if (period_.images == 0) {
    status.summary(DiagnosticStatus::OK, "waiting for images");
  } else if (period_.planes == 0 && input_.no_plane) {
    // Before what slowness says: it does not keep planes away, and looking for the cause takes
    // time.
    status.summary(DiagnosticStatus::WARN, input_.no_plane->text);
  } else if (static_cast<double>(overtaken) > kManyOvertaken * received) {
    status.summaryf(DiagnosticStatus::WARN, "too slow: newer images overtook %lu of %.0f",
                    overtaken, received);
  } else if (period_.planes == 0) {
    status.summary(DiagnosticStatus::WARN, "no plane: " + reason_);
  } else if (!input_.robot.mount.empty()) {
    status.summary(DiagnosticStatus::WARN, input_.robot.mount);
  } else if (!input_.robot.remark.empty()) {
    status.summary(DiagnosticStatus::WARN, input_.robot.remark);
  } else {
    status.summaryf(DiagnosticStatus::OK, "a plane in %lu of %lu images, %.1f images a second",
                    period_.planes, period_.images, rate());
  }
}

/// @return of what `summarise` tells.
std::optional<Finding> DetectionDiagnostics::cause() const {
  if (input_.problem) return input_.problem;
  if (input_.counts.refused > reported_.refused) return input_.counts.refusal;
  return input_.no_plane;
}

void DetectionDiagnostics::addValues(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  status.add("state of the last image", state_);
  status.add("reason", reason_);
  const std::optional<Finding> known = cause();
  status.add(keys::kCause, known ? asLine(*known) : "");
  status.addf("rate [1/s]", "%.2f", rate());
  const auto images = static_cast<double>(std::max<std::uint64_t>(period_.images, 1));
  status.addf("time an image, mean [ms]", "%.3f", 1e3 * period_.sum_seconds / images);
  status.addf("time an image, longest [ms]", "%.3f", 1e3 * period_.most_seconds);
  status.add("up is known by", input_.robot.up_source);
  status.add("up, what is passed over", input_.robot.remark);
  status.add(keys::kMount, input_.robot.mount);
  status.add(keys::kMountIsHeight, static_cast<int>(input_.robot.mount_is_height));
  status.add(keys::kPlanesAtTfHeight, input_.robot.heights.expected);
  status.add(keys::kPlanesElsewhere, input_.robot.heights.others);
  status.add(keys::kTfProblem, input_.robot.tf_problem);
  status.add(keys::kTfImages, input_.robot.tf.images);
  status.add(keys::kTfMissing, input_.robot.tf.missing);
  status.add(keys::kTfLate, input_.robot.tf.late);
  status.addf(keys::kHeight, "%.4f", input_.robot.height);
  status.addf(keys::kTfHeight, "%.4f", input_.robot.tf_height);
  status.add(keys::kDepthTopic, input_.topics.depth);
  status.add(keys::kInfoTopic, input_.topics.info);
  status.add(keys::kPointsTopic, input_.topics.points);
  status.add("images received", input_.counts.received);
  status.add("dropped images, overtaken by newer ones", input_.counts.overtaken);
  status.add("dropped images, unusable", input_.counts.refused);
}

}  // namespace dominant_plane_detection
