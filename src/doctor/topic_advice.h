#pragma once

#include <string>
#include <vector>

#include "doctor/facts.h"

namespace dominant_plane_detection {

// What to do about a topic that is the wrong one.

/// @return names in one line, or "none".
std::string listed(const std::vector<std::string>& names);
/// @param topics one at least.
/// @return the one that is depth by its name, or else the first.
const std::string& likeliestDepth(const std::vector<std::string>& topics);
/// @return the remap that gives a detection another topic, of which there is one at least.
std::string remapTo(const InputFacts& input);
/// @return sentences with all of them; nothing where there is none.
std::string chooseAnother(const InputFacts& input);
/// @return what to do about a recording of depth that an image_transport packed, or nothing.
std::string unpackFirst(const TopicFacts& depth);

}  // namespace dominant_plane_detection
