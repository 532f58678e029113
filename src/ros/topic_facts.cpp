#include "ros/topic_facts.h"

#include <algorithm>

namespace dominant_plane_detection {

std::optional<ros::master::V_TopicInfo> publishedTopics() {
  ros::master::V_TopicInfo topics;
  // Asked for topics at once, roscpp would wait for the master.
  if (!ros::master::check() || !ros::master::getTopics(topics)) return std::nullopt;
  return topics;
}

TopicFacts topicFacts(const std::optional<ros::master::V_TopicInfo>& published,
                      const std::string& name, const std::string& expected_type) {
  TopicFacts facts;
  facts.name = name;
  facts.expected_type = expected_type;
  facts.known = published.has_value();
  if (!published) return facts;
  for (const ros::master::TopicInfo& topic : *published) {
    if (topic.name == name) {
      facts.type = topic.datatype;
    } else if (topic.datatype == expected_type) {
      facts.others.push_back(topic.name);
    }
  }
  return facts;
}

void takeTransport(const std::optional<ros::master::V_TopicInfo>& published,
                   const std::string& transport_topic, TopicFacts& facts) {
  if (!published || transport_topic.empty() || transport_topic == facts.name) return;
  const bool comes = std::any_of(
      published->begin(), published->end(),
      [&](const ros::master::TopicInfo& topic) { return topic.name == transport_topic; });
  facts.type = comes ? facts.expected_type : "";
}

}  // namespace dominant_plane_detection
