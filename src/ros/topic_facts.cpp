#include "ros/topic_facts.h"

#include <ros/master.h>

namespace dominant_plane_detection {

TopicFacts topicFacts(const std::string& name, const std::string& expected_type) {
  TopicFacts facts;
  facts.name = name;
  facts.expected_type = expected_type;
  ros::master::V_TopicInfo topics;
  if (!ros::master::getTopics(topics)) facts.others = {"(the master does not answer)"};
  for (const ros::master::TopicInfo& topic : topics) {
    if (topic.name == name) {
      facts.type = topic.datatype;
    } else if (topic.datatype == expected_type) {
      facts.others.push_back(topic.name);
    }
  }
  return facts;
}

}  // namespace dominant_plane_detection
