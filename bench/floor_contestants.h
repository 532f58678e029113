#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "dominant_plane_detection/detection.h"
#include "support/recordings.h"

namespace dominant_plane_detection {

/// [-] `Label` of each pixel.
using Labels = std::vector<std::uint8_t>;

/// Something that tells the ground from what stands on it.
struct Contestant {
  std::string name;
  /// From an image, and what the detector found in it.
  std::function<Labels(const DepthView&, const Detection&)> labels;
  int most = 1000000;  ///< [#] objects a cell
};

/// The detector itself, fixed heights over its plane, and published plane detectors: for these,
/// ground is their largest plane, and the detector's plane says what is above it.
/// @param set has to outlive them.
std::vector<Contestant> contestants(const ReferenceSet& set, bool others);

}  // namespace dominant_plane_detection
