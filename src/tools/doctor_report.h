#pragma once

#include <optional>
#include <string>

#include "doctor/finding.h"
#include "doctor_settings.h"
#include "dominant_plane_detection/camera_model.h"

namespace dominant_plane_detection {

/// What a system, a detection in it, or a recording was found to be.
struct DoctorReport {
  std::string name;       ///< of what was looked at
  std::string looked_at;  ///< how much of it, in words
  Findings findings;
};

/// What to look at of a recording.
struct RecordingOptions {
  std::string topic;                  ///< empty: the only one
  std::optional<CameraModel> camera;  ///< instead of camera_info
};

/// @throw std::runtime_error for a file that is no bag, or with several depth topics and none
/// chosen.
DoctorReport examineBag(const std::string& file, const DoctorSettings& settings,
                        const RecordingOptions& options);

/// PNG files, a folder of them, or an .oni recording: what images themselves tell.
/// @throw std::runtime_error for what cannot be read.
DoctorReport examineFrames(const std::string& path, const DoctorSettings& settings,
                           const SourceOptions& options);

}  // namespace dominant_plane_detection
