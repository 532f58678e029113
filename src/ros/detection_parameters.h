#pragma once

#include <string>

#include "dominant_plane_detection/parameters.h"
#include "ros/ros_parameters.h"

namespace dominant_plane_detection {

inline std::string configValue(Algorithm value) {
  return kChoiceNames<Algorithm>[static_cast<std::size_t>(value)];
}
inline std::string configValue(Preference value) {
  return kChoiceNames<Preference>[static_cast<std::size_t>(value)];
}

}  // namespace dominant_plane_detection
