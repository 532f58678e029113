#pragma once

#include "dominant_plane_detection/noise_model.h"
#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// When a candidate may join a region (section III.B). Constant in the paper, here of the depth z.
struct GrowthThresholds {
  NoiseModel noise;
  DepthThreshold delta;    ///< [m] farthest from the region's nearest point
  DepthThreshold epsilon;  ///< [m] square root of the largest mean square error
  DepthThreshold gamma;    ///< [m] farthest from the plane refitted with the candidate
};

/// @return the thresholds among the parameters.
inline GrowthThresholds growthThresholds(const Parameters& parameters) {
  return {parameters.noise, parameters.delta, parameters.epsilon, parameters.gamma};
}

}  // namespace dominant_plane_detection
