#pragma once

#include <vector>

#include "calibration/depth_fit.h"

namespace dominant_plane_detection {

/// A fit that a few pairs far off do not move, its pairs with the standard deviations that belong
/// to it, and how large errors are.
struct RobustDepthFit {
  DepthCalibration calibration;
  std::vector<DepthPair> pairs;
  std::vector<double> sizes;  ///< [-] of the errors, in standard deviations
  double scale = 0.0;         ///< [-] robust standard deviation of the errors
};

/// @param form instead of that of the options.
/// @throw std::invalid_argument where the form does not describe the pairs.
RobustDepthFit fitRobustly(DepthCalibration::Form form, const std::vector<DepthPair>& measured,
                           const DepthFitOptions& options);

/// Weights of 0 for outliers, 1 for the rest. An outlier is what neither form explains: where the
/// form that is asked for does not describe the sensor, that is not the pairs' fault.
/// @param asked the fit of the form that is asked for, to the same pairs.
std::vector<double> findInliers(const RobustDepthFit& asked, const std::vector<DepthPair>& measured,
                                const DepthFitOptions& options);

}  // namespace dominant_plane_detection
