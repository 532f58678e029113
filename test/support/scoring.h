#pragma once

#include <cstdint>
#include <vector>

#include "dominant_plane_detection/detection.h"
#include "support/recordings.h"

namespace dominant_plane_detection {

/// A detection against the truth.
struct Score {
  bool found = false;
  double iou = 0.0;        ///< [-] where the choice of the ground band does not decide
  double plain_iou = 0.0;  ///< [-] over the whole working range
  double angle = 0.0;      ///< [rad] between the normals
  double height = 0.0;     ///< [m] absolute difference
  double ms = 0.0;         ///< [ms] of the detection, filled in by whoever timed it

  /// No plane, a plane that is off by more than 10 degrees, or one seen in the wrong place.
  bool failed() const { return !found || angle > 0.1745 || iou < 0.5; }
};

/// Intersection over union of the detected and the true ground, within the working range. `iou`
/// leaves out the pixels between one and five sigma(z) of the true plane, where one sensible ground
/// band and another disagree.
Score score(const Detection& detection, const ReferenceSet& set, const ReferenceImage& truth);

/// Median and tenth percentiles of many scores. Angles and heights are over those with a plane.
struct Summary {
  std::size_t images = 0;
  std::size_t failures = 0;
  double iou_median = 0.0, iou_p10 = 0.0;              ///< [-]
  double plain_iou_median = 0.0, plain_iou_p10 = 0.0;  ///< [-]
  double angle_median = 0.0, angle_p90 = 0.0;          ///< [rad]
  double height_median = 0.0, height_p90 = 0.0;        ///< [m]
  double ms_median = 0.0;                              ///< [ms]
};

Summary summarize(const std::vector<Score>& scores);

/// @param share [-] 0.5 for the median; linear between the neighbours.
/// @return NaN without values.
double quantile(std::vector<double> values, double share);

/// @return [-] intersection over union of the pixels that two detections label ground.
double groundOverlap(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b);

}  // namespace dominant_plane_detection
