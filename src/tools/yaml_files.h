#pragma once

#include <string>

#include "dominant_plane_detection/camera_model.h"
#include "ros/parameter_file.h"

namespace dominant_plane_detection {

/// Reads a calibration file as camera_calibration writes it.
/// @throw std::runtime_error that names the file and what is wrong in it.
CameraModel loadCamera(const std::string& file);

}  // namespace dominant_plane_detection
