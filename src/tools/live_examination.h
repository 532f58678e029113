#pragma once

#include <dominant_plane_detection/DominantPlane.h>
#include <ros/node_handle.h>

#include <cstddef>
#include <memory>
#include <string>

#include "detection_status.h"
#include "doctor/facts.h"
#include "doctor_live.h"
#include "live_input.h"

namespace dominant_plane_detection {

/// What a detection nodelet is doing, while this listens.
class LiveExamination {
 public:
  /// @param name of the nodelet; empty: of `options.topic` alone.
  LiveExamination(ros::NodeHandle& node, const DetectionStatus& status, const std::string& name,
                  const SourceArguments& arguments, const LiveOptions& options);

  /// To be called a few times a second.
  void look() { input_->look(); }
  DoctorReport report(const ClockFacts& clock) const;

 private:
  void onPlane(const DominantPlaneConstPtr& plane);
  Findings imageFindings() const;
  RobotFacts robot() const;
  std::string summary() const;

  std::string name_;
  const DetectionStatus& status_;
  DoctorSettings settings_;
  bool tries_;  ///< itself, not the detection
  std::string topic_;
  std::unique_ptr<LiveInput> input_;
  ros::Subscriber planes_;
  std::size_t images_ = 0;
  std::size_t found_ = 0;  ///< [#] of them with a plane
};

}  // namespace dominant_plane_detection
