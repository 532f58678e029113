#pragma once

#include <optional>
#include <string>
#include <vector>

#include "doctor_report.h"

namespace dominant_plane_detection {

/// What to look at of a running system.
struct LiveOptions {
  std::string topic;                  ///< of depth; empty: what the detections take
  std::string node;                   ///< of a detection; empty: each
  std::optional<CameraModel> camera;  ///< instead of any camera_info
  double duration = 10.0;             ///< [s] to listen
};

/// Listens to the detections that run, which it wakes, and to what they take.
/// @param arguments override what a node's parameters are; where there are any, images are looked
/// at by them, and not by what the node says of its own.
/// @return one report a detection, or one of the topic.
/// @throw std::runtime_error without a master, and where there is nothing to look at.
std::vector<DoctorReport> examineLive(const SourceArguments& arguments, const LiveOptions& options);

}  // namespace dominant_plane_detection
