#include "live_examination.h"

#include <image_transport/camera_common.h>

#include "doctor/input_rules.h"
#include "doctor/robot_rules.h"
#include "doctor/time_rules.h"
#include "ros/correction_parameter.h"
#include "ros/diagnostic_keys.h"

namespace dominant_plane_detection {
namespace {

DoctorSettings settingsOf(const std::string& node, const SourceArguments& arguments) {
  DoctorSettings settings;
  if (!node.empty()) {
    const ros::NodeHandle handle(node);
    readValues(handle, settings.detection);
    readValues(handle, settings.node);
    if (handle.param<std::string>("input", "") == "points") settings.points = true;
    settings.rectified = handle.param("rectified", false);
    settings.transport = handle.param<std::string>("image_transport", "raw");
    settings.correction = readCorrection(handle);
  }
  settings.take(arguments);
  return settings;
}

/// @return whether other images are to be looked at than the node's, or otherwise than it does.
bool overrides(const SourceArguments& arguments, const LiveOptions& options) {
  return !options.topic.empty() || options.camera || !arguments.params.empty() ||
         !arguments.sensor.empty() || !arguments.settings.empty() || !arguments.range.empty() ||
         !arguments.algorithm.empty() || !arguments.correction.empty();
}

}  // namespace

LiveExamination::LiveExamination(ros::NodeHandle& node, const DetectionStatus& status,
                                 const std::string& name, const SourceArguments& arguments,
                                 const LiveOptions& options)
    : name_(name),
      status_(status),
      settings_(settingsOf(name, arguments)),
      tries_(name.empty() || overrides(arguments, options)) {
  topic_ = status.value(name, settings_.points ? keys::kPointsTopic : keys::kDepthTopic);
  std::string info = status.value(name, keys::kInfoTopic);
  if (!options.topic.empty()) {
    topic_ = ros::names::resolve(options.topic);
    info = image_transport::getCameraInfoTopic(topic_);
  }
  input_ = std::make_unique<LiveInput>(node, settings_, topic_, info, options.camera, tries_);
  if (name.empty()) return;
  // A detection is idle until somebody wants its planes.
  planes_ = node.subscribe(name + "/plane", 10, &LiveExamination::onPlane, this);
}

void LiveExamination::onPlane(const DominantPlaneConstPtr& plane) {
  ++images_;
  if (plane->state == DominantPlane::FOUND) ++found_;
}

DoctorReport LiveExamination::report(const ClockFacts& clock) const {
  const InputFacts input = input_->facts();
  DoctorReport report{name_.empty() ? topic_ : name_, summary(), {}};
  const auto add = [&](const Findings& more) {
    for (const Finding& finding : more) {
      if (!hasCode(report.findings, finding.code)) report.findings.push_back(finding);
    }
  };
  if (const auto no_clock = findNoClock(clock)) report.findings.push_back(*no_clock);
  // Without time a driver may stand still, and stamps say nothing.
  const bool stopped = !report.findings.empty();
  for (const Finding& finding : examineInput(input)) {
    const bool follows = stopped && finding.code == Code::kNoImages && !input.depth.type.empty();
    if (!follows) add({finding});
  }
  add(imageFindings());
  add(examineRobot(robot()));
  const std::string error = status_.lastingError(name_);
  if (report.findings.empty() && !error.empty()) {
    add({{Code::kUnusableImages,
          "The detection reports an error in /diagnostics: " + inOneLine(error)}});
  }
  return report;
}

/// What the detection itself has tried, as it knows the robot; and what it does not look for.
Findings LiveExamination::imageFindings() const {
  Findings findings = input_->study().findings();
  if (tries_) return findings;
  const std::string cause = status_.value(name_, keys::kCause);
  for (const Code code : {Code::kDepthScale, Code::kUpsideDown, Code::kRangeMax}) {
    const std::string begin = std::string(codeName(code)) + ": ";
    if (cause.rfind(begin, 0) != 0) continue;
    // The detection's images may be upside down, and mirrored by that.
    if (code == Code::kUpsideDown || hasCode(findings, code)) findings.clear();
    findings.push_back({code, cause.substr(begin.size())});
  }
  return findings;
}

RobotFacts LiveExamination::robot() const {
  const auto number = [&](const char* key) {
    const std::string text = status_.value(name_, key);
    return text.empty() ? 0.0 : std::stod(text);
  };
  RobotFacts facts;
  facts.base_frame = settings_.node.base_frame;
  if (name_.empty()) return facts;
  const std::size_t missing = status_.growth(name_, keys::kTfMissing);
  if (2 * missing > status_.growth(name_, keys::kTfImages)) {
    facts.tf_problem = status_.lastSaid(name_, keys::kTfProblem);
    facts.tf_is_late = 2 * status_.growth(name_, keys::kTfLate) > missing;
  }
  facts.mount = status_.lasting(name_, keys::kMount);
  facts.mount_is_height = number(keys::kMountIsHeight) != 0.0;
  facts.planes_at_tf_height = static_cast<std::size_t>(number(keys::kPlanesAtTfHeight));
  facts.planes_elsewhere = static_cast<std::size_t>(number(keys::kPlanesElsewhere));
  // A single plane may be a table's.
  if (facts.mount.empty()) return facts;
  facts.height = number(keys::kHeight);
  facts.tf_height = number(keys::kTfHeight);
  return facts;
}

std::string LiveExamination::summary() const {
  std::string text = std::to_string(input_->messages()) + " images of " + topic_;
  if (!name_.empty()) {
    text += ", a plane in " + std::to_string(found_) + " of " + std::to_string(images_);
  }
  return text;
}

}  // namespace dominant_plane_detection
