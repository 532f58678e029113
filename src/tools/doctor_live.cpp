#include "doctor_live.h"

#include <dominant_plane_detection/DominantPlane.h>
#include <image_transport/camera_common.h>
#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <stdexcept>

#include "detection_status.h"
#include "doctor/input_rules.h"
#include "doctor/robot_rules.h"
#include "doctor/time_rules.h"
#include "live_input.h"
#include "ros/diagnostic_keys.h"

namespace dominant_plane_detection {
namespace {

/// Handles callbacks, and calls `often` four times a second, until the time is over or `done`.
void spinFor(
    double seconds, const std::function<void()>& often,
    const std::function<bool()>& done = [] { return false; }) {
  constexpr double kPeriod = 0.25;  // [s]
  const auto now = [] { return ros::SteadyTime::now().toSec(); };
  const double end = now() + seconds;
  double next = now();
  while (ros::ok() && now() < end && !done()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
    if (now() < next) continue;
    next = now() + kPeriod;
    often();
  }
}

DoctorSettings settingsOf(const std::string& node, const SourceArguments& arguments) {
  DoctorSettings settings;
  if (!node.empty()) {
    const ros::NodeHandle handle(node);
    readValues(handle, settings.detection);
    readValues(handle, settings.node);
    if (handle.param<std::string>("input", "") == "points") settings.points = true;
    settings.rectified = handle.param("rectified", false);
    settings.transport = handle.param<std::string>("image_transport", "raw");
  }
  settings.take(arguments);
  return settings;
}

/// What a detection nodelet is doing, while this listens.
class LiveExamination {
 public:
  /// @param name of the nodelet; empty: of `options.topic` alone.
  LiveExamination(ros::NodeHandle& node, const DetectionStatus& status, const std::string& name,
                  const SourceArguments& arguments, const LiveOptions& options)
      : name_(name), status_(status), settings_(settingsOf(name, arguments)) {
    const bool points = settings_.points;
    std::string depth = status.value(name, points ? keys::kPointsTopic : keys::kDepthTopic);
    std::string info = status.value(name, keys::kInfoTopic);
    if (!options.topic.empty()) {
      depth = ros::names::resolve(options.topic);
      info = image_transport::getCameraInfoTopic(depth);
    }
    input_ = std::make_unique<LiveInput>(node, settings_, depth, info, options.camera);
    topic_ = depth;
    if (name.empty()) return;
    // A detection is idle until somebody wants its planes.
    planes_ = node.subscribe(name + "/plane", 10, &LiveExamination::onPlane, this);
  }

  void look() { input_->look(); }

  DoctorReport report(const ClockFacts& clock) const {
    const InputFacts input = input_->facts();
    DoctorReport report{name_.empty() ? topic_ : name_, lookedAt(), {}};
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
    add(name_.empty() ? input_->study().findings() : imageFindings());
    add(examineRobot(robot()));
    return report;
  }

 private:
  void onPlane(const DominantPlaneConstPtr& plane) {
    ++images_;
    if (plane->state == DominantPlane::FOUND) ++found_;
  }

  /// What the detection itself has tried, as it knows the robot; and what it does not look for.
  Findings imageFindings() const {
    Findings findings = input_->study().findingsWithoutTrials();
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

  RobotFacts robot() const {
    const auto number = [&](const char* key) {
      const std::string text = status_.value(name_, key);
      return text.empty() ? 0.0 : std::stod(text);
    };
    RobotFacts facts;
    facts.base_frame = settings_.node.base_frame;
    if (name_.empty()) return facts;
    facts.tf_problem = status_.lasting(name_, keys::kTfProblem);
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

  std::string lookedAt() const {
    std::string text = std::to_string(input_->messages()) + " images of " + topic_;
    if (!name_.empty()) {
      text += ", a plane in " + std::to_string(found_) + " of " + std::to_string(images_);
    }
    return text;
  }

  std::string name_;
  const DetectionStatus& status_;
  DoctorSettings settings_;
  std::string topic_;
  std::unique_ptr<LiveInput> input_;
  ros::Subscriber planes_;
  std::size_t images_ = 0;
  std::size_t found_ = 0;  ///< [#] of them with a plane
};

/// @return the topics of planes, each below its node's name, of any node.
std::size_t planeTopics() {
  std::size_t count = 0;
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  for (const auto& topic : topics) {
    if (topic.datatype == "dominant_plane_detection/DominantPlane") ++count;
  }
  return count;
}

/// @return the detections to look at; one without a name for a topic alone.
std::vector<std::string> chooseNodes(const DetectionStatus& status, const LiveOptions& options) {
  const std::vector<std::string> nodes = status.nodes();
  if (!options.node.empty()) {
    const std::string wanted = ros::names::resolve(options.node);
    for (const std::string& name : nodes) {
      if (name == wanted) return {wanted};
    }
    throw std::runtime_error("there is no detection " + wanted + ", but " + listed(nodes));
  }
  if (!options.topic.empty()) return {""};
  if (!nodes.empty()) return nodes;
  throw std::runtime_error(
      "no detection runs (none is in /diagnostics): start one, such as with detection.launch, name "
      "a depth topic with --topic, or give a recording");
}

}  // namespace

std::vector<DoctorReport> examineLive(const SourceArguments& arguments,
                                      const LiveOptions& options) {
  constexpr double kPatience = 3.0;  // [s] for diagnostics, which come once a second
  if (!ros::master::check()) {
    throw std::runtime_error("no ROS master answers at " + ros::master::getURI() +
                             ": start the system, or give a recording");
  }
  ros::NodeHandle node;
  DetectionStatus status(node);
  const std::size_t topics = planeTopics();
  const bool wanted = options.topic.empty() || !options.node.empty();
  if (wanted) {
    spinFor(
        kPatience, [] {}, [&] { return topics > 0 && status.nodes().size() >= topics; });
  }
  std::vector<std::unique_ptr<LiveExamination>> examinations;
  for (const std::string& name : chooseNodes(status, options)) {
    examinations.push_back(
        std::make_unique<LiveExamination>(node, status, name, arguments, options));
  }
  spinFor(options.duration, [&] {
    for (const auto& each : examinations) each->look();
  });
  ClockFacts clock;
  clock.use_sim_time = ros::param::param("/use_sim_time", false);
  clock.ticks = !ros::Time::isSimTime() || !ros::Time::now().isZero();
  std::vector<DoctorReport> reports;
  for (const auto& each : examinations) reports.push_back(each->report(clock));
  return reports;
}

}  // namespace dominant_plane_detection
