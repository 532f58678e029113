#pragma once

#include <vector>

#include "calibration/depth_pair.h"
#include "dominant_plane_detection/depth_calibration.h"

namespace dominant_plane_detection {

struct DepthFitOptions {
  DepthCalibration::Form form = DepthCalibration::Form::kReciprocal;
  double distance_sigma = 0.002;  ///< [m] of the tape measure
  /// [-] Of the raw value of a wall, a mean of thousands of readings: not their noise, which that
  /// takes away, but the sensor's smooth error, which is the same all over the wall. That of an
  /// Xtion is 0.68 and 0.24 mm/m^2 (docs/scenes.md), with 3.07 mm/m^2 a raw value (kinect()).
  double raw_sigma = 0.25;
  bool minimax = false;  ///< the largest error as small as can be, in sigmas, for a table without
                         ///< noise, instead of least squares
};

struct DepthFit {
  DepthCalibration calibration;
  DepthCalibration standard_errors;  ///< of the constants, see `standardErrors`; 0 with `minimax`
  std::vector<double> residuals;     ///< [m] fitted minus measured, of all pairs
  std::vector<bool> outliers;        ///< pairs that were left out
  double rms = 0.0;                  ///< [m] of those that were not
  double worst = 0.0;                ///< [m] of those that were not
  double sigmas = 0.0;               ///< [-] the same root mean square in the standard deviations
                                     ///< of the pairs: about 1 where the form describes them
};

/// Fits one form of `DepthCalibration` to measured pairs, each weighted by the error of its
/// distance: that of the tape and that of the raw value, which grows with the slope of the curve.
/// Pairs that are off by more than four standard deviations of the rest are left out.
/// @throw std::invalid_argument that says what is wrong with the pairs: too few for the form's
/// constants, values that cannot be, distances that do not grow with the raw value, or more than a
/// quarter that do not fit.
DepthFit fitDepth(const std::vector<DepthPair>& pairs, const DepthFitOptions& options);

}  // namespace dominant_plane_detection
