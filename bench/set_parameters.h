#pragma once

#include <string>
#include <vector>

#include "ros/sensor_profiles.h"
#include "support/recordings.h"
#include "tools/source_arguments.h"
#include "tools/yaml_files.h"

namespace dominant_plane_detection {

/// @param settings NAME=VALUE, which win over the rest.
/// @return the defaults with a set's working range and its sensor's profile.
inline Parameters parametersOf(const ReferenceSet& set, const std::string& sensor,
                               const std::vector<std::string>& settings) {
  Parameters parameters;
  parameters.range_min = set.range_min;
  parameters.range_max = set.range_max;
  loadParameters(findSensorProfile(sensor), parameters);
  applySettings(settings, parameters);
  return parameters;
}

}  // namespace dominant_plane_detection
