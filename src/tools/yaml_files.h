#pragma once

#include <string>

#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// Reads detection parameters from the nodelet's YAML file; what it does not name stays.
/// @throw std::runtime_error that names the file and what is wrong in it.
void loadParameters(const std::string& file, Parameters& parameters);

/// Reads a calibration file as camera_calibration writes it.
/// @throw std::runtime_error that names the file and what is wrong in it.
CameraModel loadCamera(const std::string& file);

}  // namespace dominant_plane_detection
