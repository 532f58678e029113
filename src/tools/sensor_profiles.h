#pragma once

#include <string>

namespace dominant_plane_detection {

/// Finds a sensor's profile: a YAML file of detection parameters, in the package's config/sensors
/// by its name, or anywhere by its path.
/// @throw std::invalid_argument that lists the profiles there are.
std::string findSensorProfile(const std::string& sensor);

}  // namespace dominant_plane_detection
