#pragma once

#include <dominant_plane_detection/PlaneDetectionConfig.h>

#include <string>

#include "dominant_plane_detection/parameters.h"
#include "ros/ros_parameters.h"

namespace dominant_plane_detection {

inline std::string configValue(Algorithm algorithm) {
  return algorithm == Algorithm::kGrid ? "grid" : "kdtree";
}

}  // namespace dominant_plane_detection
