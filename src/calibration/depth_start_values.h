#pragma once

#include <vector>

#include "calibration/depth_constants.h"
#include "calibration/depth_pair.h"

namespace dominant_plane_detection {

/// Where to start a least squares fit from, by linear least squares.
/// @param pairs with a standard deviation each.
/// @param weights [-] one a pair; 0 leaves it out.
/// @return one start for the reciprocal form, several for the exponential one, best first.
std::vector<DepthConstants> startValues(DepthCalibration::Form form,
                                        const std::vector<DepthPair>& pairs,
                                        const std::vector<double>& weights);

}  // namespace dominant_plane_detection
