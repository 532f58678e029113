#pragma once

#include <string>

#include "dominant_plane_detection/parameters.h"
#include "ros/ros_parameters.h"

namespace dominant_plane_detection {

inline std::string configValue(Algorithm algorithm) {
  return kAlgorithmNames[static_cast<std::size_t>(algorithm)];
}

}  // namespace dominant_plane_detection
