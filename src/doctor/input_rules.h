#pragma once

#include <optional>

#include "doctor/facts.h"
#include "doctor/finding.h"

namespace dominant_plane_detection {

// One rule each: nothing where all is well, and where there is nothing to judge.

std::optional<Finding> findNotSubscribed(const InputFacts& input);
std::optional<Finding> findSwappedTopics(const InputFacts& input);
std::optional<Finding> findNoImages(const InputFacts& input);
std::optional<Finding> findWrongEncoding(const InputFacts& input);
std::optional<Finding> findNoCameraInfo(const InputFacts& input);
std::optional<Finding> findUncalibrated(const InputFacts& input);
std::optional<Finding> findCameraInfoSize(const InputFacts& input);

/// All of what keeps images from being looked at, or makes them late. One cause is told: where
/// images are of a wrong encoding nobody wants to hear of their size.
Findings examineInput(const InputFacts& input);

}  // namespace dominant_plane_detection
