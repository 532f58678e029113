#pragma once

#include <string>

#include "dominant_plane_detection/depth_calibration.h"

namespace dominant_plane_detection {

/// A depth calibration as YAML: `form` (reciprocal or exponential) and the constants a, b (c, d),
/// and what else `calibrate_depth` has to say.
struct DepthCalibrationFile {
  DepthCalibration calibration;
  DepthCalibration standard_errors;  ///< of the constants; 0 where they are not known
  std::string description;           ///< where it comes from, for people
};

/// @throw std::runtime_error that names the file, what was expected and what came.
DepthCalibration loadDepthCalibration(const std::string& file);

/// @throw std::runtime_error when the file cannot be written.
void saveDepthCalibration(const std::string& file, const DepthCalibrationFile& content);

}  // namespace dominant_plane_detection
