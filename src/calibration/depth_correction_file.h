#pragma once

#include <string>

#include "calibration/floor_correction.h"
#include "dominant_plane_detection/depth_correction.h"

namespace dominant_plane_detection {

/// @throw std::runtime_error that names the file, what was expected and what came.
DepthCorrection loadDepthCorrection(const std::string& file);

/// Writes what was learned as YAML, with what it gained for people.
/// @throw std::runtime_error when the file cannot be written.
void saveDepthCorrection(const std::string& file, const FloorCorrection::Result& learned);

}  // namespace dominant_plane_detection
