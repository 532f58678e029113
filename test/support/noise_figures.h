#pragma once

#include <array>
#include <vector>

#include "support/recordings.h"

namespace dominant_plane_detection {

/// How the height of floor readings over their best plane errs between `nearest` and `farthest` of
/// the depth, over all images of a set: measured alike on recordings and on scenes.
struct NoiseFigures {
  double nearest = 0.0;    ///< [m]
  double farthest = 0.0;   ///< [m]
  std::size_t pixels = 0;  ///< [#] of floor
  double height = 0.0;     ///< [m] root mean square
  double neighbour = 0.0;  ///< [m] median absolute difference to the next pixel of the row
  double local = 0.0;  ///< [m] root mean square of the means of 4 x 4 pixels, less the median of
                       ///< the 15 x 15 such means about each
};

/// The floor is what the set's masks say between 0.5 and 4 m, within three sigma(z) of the known
/// plane; its plane in each image is the least-squares fit to these readings, weighted by 1 /
/// sigma(z)^2 of the default `NoiseModel`.
/// @return one for each half metre; NaN where there is no floor.
std::vector<NoiseFigures> noiseFigures(const ReferenceSet& set);

}  // namespace dominant_plane_detection
