#pragma once

#include <string>
#include <vector>

#include "calibration/depth_fit.h"

namespace dominant_plane_detection {

/// The picture of Fig. 2 as PNG: distance over raw value, points and curve, and the residuals
/// below. Drawn by gnuplot.
/// @throw std::runtime_error when gnuplot is missing or the file cannot be written.
void plotFit(const std::string& file, const std::vector<DepthPair>& pairs, const DepthFit& fit);

}  // namespace dominant_plane_detection
