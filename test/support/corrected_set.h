#pragma once

#include "dominant_plane_detection/parameters.h"
#include "support/recordings.h"

namespace dominant_plane_detection {

/// Learns a set's fixed error five times with a fifth of neighbouring images left out, and corrects
/// these.
/// @param parameters of the detections.
/// @return the set with every image corrected by what was learned from the others.
/// @throw std::runtime_error where the correction is refused.
ReferenceSet correctByFolds(const ReferenceSet& set, const Parameters& parameters);

}  // namespace dominant_plane_detection
