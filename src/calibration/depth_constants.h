#pragma once

#include <array>

#include "dominant_plane_detection/depth_calibration.h"

namespace dominant_plane_detection {

/// The constants a, b, c, d of a `DepthCalibration` as a solver takes them.
using DepthConstants = std::array<double, 4>;

/// @return [#] how many of them a form has.
inline int countConstants(DepthCalibration::Form form) {
  return form == DepthCalibration::Form::kExponential ? 4 : 2;
}

inline DepthConstants toConstants(const DepthCalibration& c) { return {c.a, c.b, c.c, c.d}; }

inline DepthCalibration toCalibration(DepthCalibration::Form form, const DepthConstants& c) {
  return form == DepthCalibration::Form::kExponential
             ? DepthCalibration{form, c[0], c[1], c[2], c[3]}
             : DepthCalibration{form, c[0], c[1], 0.0, 0.0};
}

}  // namespace dominant_plane_detection
