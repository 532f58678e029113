#pragma once

#include <vector>

#include "calibration/depth_constants.h"
#include "calibration/depth_pair.h"

namespace dominant_plane_detection {

/// @param pairs with a standard deviation each.
/// @return the fit whose largest error, in standard deviations, is as small as can be.
/// @throw std::invalid_argument where the form does not describe the pairs.
DepthCalibration fitMinimax(DepthCalibration::Form form, const std::vector<DepthPair>& pairs);

}  // namespace dominant_plane_detection
