#pragma once

#include <string>
#include <vector>

namespace dominant_plane_detection {

/// A distance that was measured, and what the sensor said.
struct DepthPair {
  double raw = 0.0;       ///< [-] raw disparity, a mean with a fraction mostly
  double distance = 0.0;  ///< [m] along the optical axis
  double sigma = 0.0;     ///< [m] standard deviation of the distance; 0: that of the options
};

/// @return the pair as messages to users have it.
std::string describe(const DepthPair& pair);

/// Refuses pairs that no calibration can be fitted to.
/// @param constants [#] of the form that is to be fitted.
/// @throw std::invalid_argument that says what is wrong: values that cannot be, fewer different raw
/// values than constants and one more, or distances that do not grow with the raw value.
void requireUsable(const std::vector<DepthPair>& pairs, int constants);

}  // namespace dominant_plane_detection
