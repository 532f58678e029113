#include "doctor_live.h"

#include <ros/callback_queue.h>
#include <ros/master.h>
#include <ros/ros.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>

#include "detection_status.h"
#include "doctor/topic_advice.h"
#include "live_examination.h"
#include "ros/topic_facts.h"

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

/// @return [#] topics of planes, each below its node's name, of any node.
std::size_t planeTopics() {
  const auto topics = publishedTopics().value_or(ros::master::V_TopicInfo());
  return static_cast<std::size_t>(
      std::count_if(topics.begin(), topics.end(), [](const ros::master::TopicInfo& topic) {
        return topic.datatype == "dominant_plane_detection/DominantPlane";
      }));
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
