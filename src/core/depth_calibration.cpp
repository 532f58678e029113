#include "dominant_plane_detection/depth_calibration.h"

#include <cmath>

namespace dominant_plane_detection {

DepthCalibration DepthCalibration::paper() {
  return {Form::kExponential, 0.8487, 0.000444, -1.585, -0.0247};
}

DepthCalibration DepthCalibration::kinect() {
  return {Form::kReciprocal, 3.3309495161, -0.0030711016, 0.0, 0.0};
}

double DepthCalibration::evaluate(double raw) const {
  return form == Form::kExponential ? a * std::exp(b * raw) + c * std::exp(d * raw)  // Eq. 1
                                    : 1.0 / (a + b * raw);
}

double DepthCalibration::distance(int raw) const {
  constexpr int kNoReading = 2047;
  if (raw < 0 || raw >= kNoReading) return 0.0;
  const double z = evaluate(raw);
  return std::isfinite(z) && z > 0.0 ? z : 0.0;
}

}  // namespace dominant_plane_detection
