#pragma once

#include <string>
#include <vector>

#include "doctor/facts.h"

namespace dominant_plane_detection {

/// What the master knows of a topic that a detection takes.
/// @param name resolved.
/// @param expected_type such as sensor_msgs/Image.
/// @return without messages.
TopicFacts topicFacts(const std::string& name, const std::string& expected_type);

}  // namespace dominant_plane_detection
