#pragma once

#include <rosbag/bag.h>

#include <map>
#include <set>
#include <string>

namespace dominant_plane_detection {

/// @return the topics whose images can be depth.
std::set<std::string> depthTopics(const rosbag::Bag& bag);

/// @return the type of each topic.
std::map<std::string, std::string> topicTypes(const rosbag::Bag& bag);

}  // namespace dominant_plane_detection
