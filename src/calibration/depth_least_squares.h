#pragma once

#include <vector>

#include "calibration/depth_constants.h"
#include "calibration/depth_pair.h"

namespace dominant_plane_detection {

// Weighted least squares of the distances' errors, by Ceres. All pairs have a standard deviation;
// weights [-] are one a pair, 0 leaves it out.

/// @return [-] fitted minus measured distances in units of their standard deviations.
std::vector<double> errorsOf(const DepthCalibration& calibration,
                             const std::vector<DepthPair>& pairs);

/// @return the best fit of a form.
/// @throw std::invalid_argument where there is none.
DepthCalibration fitLeastSquares(DepthCalibration::Form form, const std::vector<DepthPair>& pairs,
                                 const std::vector<double>& weights);

/// @return the fit that is reached from another one, that of other weights.
DepthCalibration refit(const DepthCalibration& start, const std::vector<DepthPair>& pairs,
                       const std::vector<double>& weights);

/// @return the half widths of the intervals that hold a fit's constants in 68 of 100 cases, from
/// the residuals' own size by Student's distribution; 0 where the pairs do not tell.
DepthCalibration standardErrors(const DepthCalibration& calibration,
                                const std::vector<DepthPair>& pairs,
                                const std::vector<double>& weights);

}  // namespace dominant_plane_detection
