#pragma once

#include <ros/node_handle.h>

#include <optional>

#include "dominant_plane_detection/depth_correction.h"

namespace dominant_plane_detection {

/// Reads the file that the parameter `correction` names.
/// @return nothing where it is empty; and where the file cannot be used, which the log says.
std::optional<DepthCorrection> readCorrection(const ros::NodeHandle& node);

}  // namespace dominant_plane_detection
