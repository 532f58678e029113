#pragma once

#include <string>

namespace dominant_plane_detection {

/// Finds a sensor's profile: a YAML file of detection parameters, by its name in the package's
/// config/sensors, or anywhere by its path. Both programs and nodelets find the package by where it
/// is installed.
/// @throw std::invalid_argument that lists the profiles there are.
std::string findSensorProfile(const std::string& sensor);

}  // namespace dominant_plane_detection
