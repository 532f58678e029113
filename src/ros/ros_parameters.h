#pragma once

#include <dominant_plane_detection/PlaneDetectionConfig.h>
#include <ros/node_handle.h>

#include <set>
#include <string>

#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// Reads the detection parameters of a namespace. Values that cannot be used are refused, all of
/// them in one line of the log, and their defaults stay; names that do not exist are pointed out.
/// What was accepted is written back, for dynamic_reconfigure to start from.
/// @param others names in the namespace that are no detection parameters.
Parameters loadParameters(const ros::NodeHandle& node, const std::set<std::string>& others);

/// The same values as dynamic_reconfigure has them, and back.
PlaneDetectionConfig toConfig(const Parameters& parameters);
Parameters fromConfig(const PlaneDetectionConfig& config);

/// @return the errors as one line.
std::string describeErrors(const Parameters& parameters);

}  // namespace dominant_plane_detection
