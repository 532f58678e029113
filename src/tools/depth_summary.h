#pragma once

#include <string>

#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// Says what the readings of a depth image look like, for when none of them is as expected.
/// @return one sentence with the 5th and the 95th percentile of the readings, or that there are
/// none.
std::string describeDepths(const DepthView& depth);

}  // namespace dominant_plane_detection
