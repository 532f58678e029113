#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// [-] Of the local error, what a thing has to be higher than to be told from the ground: 4.2 is
/// what one of the 160 x 120 blocks of an image exceeds in every fifth image (`false_alarm_rate`),
/// 0.6 leave the thing its own error.
constexpr double kToldFrom = 4.8;

/// @param local_error rms of 4 x 4 pixels over the ground about them. @param z [m] depth.
/// @return [m] the lowest thing that is told from the ground there.
inline double toldHeight(const NoiseModel& local_error, double z) {
  return kToldFrom * local_error.sigma(z);
}

/// @return [m] the depth to which things of a height are told from the ground: farther away what
/// looks like ground may be one.
inline double freeRange(const NoiseModel& local_error, double height) {
  const double rest = height / kToldFrom - local_error.constant;
  if (!(rest > 0.0)) return 0.0;
  return local_error.quadratic > 0.0 ? std::sqrt(rest / local_error.quadratic)
                                     : std::numeric_limits<double>::infinity();
}

}  // namespace dominant_plane_detection
