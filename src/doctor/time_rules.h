#pragma once

#include <optional>

#include "doctor/facts.h"
#include "doctor/finding.h"

namespace dominant_plane_detection {

// What is wrong with clocks and stamps; one rule each.

std::optional<Finding> findNoClock(const ClockFacts& clock);
/// @return nothing where `info_offset` is not known, as most images have a camera_info of theirs.
std::optional<Finding> findStampsApart(const InputFacts& input);
/// @return nothing of a recording, whatever its age.
std::optional<Finding> findStampsOffClock(const InputFacts& input);

}  // namespace dominant_plane_detection
