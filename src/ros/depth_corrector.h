#pragma once

#include <sensor_msgs/Image.h>

#include "core/disparity_table.h"

namespace dominant_plane_detection {

/// z' = z_scale z + z_offset for each reading of a 16UC1 image in millimetres, in place. No reading
/// (0) stays none, and what leaves the range of 16 bits becomes none.
/// @param z_offset [m]
void correctDepth(double z_offset, double z_scale, sensor_msgs::Image& depth);

/// The readings of a 16UC1 image, raw disparity, in millimetres, in place.
void toMillimetres(const DisparityTable& table, sensor_msgs::Image& depth);

}  // namespace dominant_plane_detection
