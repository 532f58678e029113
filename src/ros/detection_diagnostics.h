#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <optional>
#include <string>

#include "doctor/finding.h"
#include "dominant_plane_detection/detection.h"
#include "ros/detection_inputs.h"
#include "ros/plane_prior.h"

namespace dominant_plane_detection {

/// What /diagnostics says of a detection (REP 107): whether images come and can be looked at, how
/// many, how long each takes, and whether they show a plane. Idle is well.
class DetectionDiagnostics {
 public:
  struct Input {
    bool subscribed;
    DetectionInputs::Counts counts;
    DetectionInputs::Topics topics;
    std::optional<Finding> problem;   ///< while nothing comes that can be looked at
    std::string subscription_error;   ///< why nothing is subscribed that is wanted
    PlanePrior::Status robot;         ///< what the robot knows, and how the plane differs from it
    std::optional<Finding> no_plane;  ///< why there is no plane, where that is known
  };

  DetectionDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       const std::string& name);

  /// @param seconds [s] that the detection took.
  void count(const Detection& detection, double seconds);
  /// An image that could not be worked on.
  void countFailure(const std::string& error);
  /// Publishes what is known, and begins the next period.
  void report(const Input& input);

 private:
  /// Since the last report.
  struct Period {
    std::uint64_t images = 0;
    std::uint64_t planes = 0;
    std::uint64_t failures = 0;
    double sum_seconds = 0.0;
    double most_seconds = 0.0;
  };

  void summarise(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void addValues(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  std::optional<Finding> cause() const;
  double rate() const;

  Input input_{};
  DetectionInputs::Counts reported_;  ///< with the last report
  Period period_;
  double length_ = 0.0;  ///< [s] of the period
  ros::SteadyTime begin_;
  std::string state_ = "none";  ///< of the last image
  std::string reason_;
  diagnostic_updater::Updater updater_;
};

}  // namespace dominant_plane_detection
