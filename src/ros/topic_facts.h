#pragma once

#include <ros/master.h>

#include <optional>
#include <string>

#include "doctor/facts.h"

namespace dominant_plane_detection {

/// @return all topics that the master knows, without waiting for one that is away; then nothing.
std::optional<ros::master::V_TopicInfo> publishedTopics();

/// What the master knows of a topic that a detection takes.
/// @param name resolved.
/// @param expected_type such as sensor_msgs/Image.
/// @return without messages.
TopicFacts topicFacts(const std::optional<ros::master::V_TopicInfo>& published,
                      const std::string& name, const std::string& expected_type);

/// Images that come on a transport's own topic are of the expected type, whatever theirs is.
/// @param transport_topic such as /depth/image_raw/compressedDepth; the topic itself where it is
/// raw, and empty where nothing is subscribed.
void takeTransport(const std::optional<ros::master::V_TopicInfo>& published,
                   const std::string& transport_topic, TopicFacts& facts);

}  // namespace dominant_plane_detection
