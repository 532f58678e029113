#include "ros/topic_facts.h"

#include <gtest/gtest.h>
#include <ros/init.h>

#include <cstdlib>

namespace dominant_plane_detection {
namespace {

constexpr const char* kImage = "sensor_msgs/Image";

const ros::master::V_TopicInfo& published() {
  static const ros::master::V_TopicInfo kTopics{
      {"/depth", kImage},
      {"/other", kImage},
      {"/packed/compressedDepth", "sensor_msgs/CompressedImage"},
  };
  return kTopics;
}

TEST(TopicFacts, AreThoseOfTheMaster) {
  const TopicFacts facts = topicFacts(published(), "/depth", kImage);
  EXPECT_EQ(facts.name, "/depth");
  EXPECT_EQ(facts.type, kImage);
  EXPECT_EQ(facts.others, std::vector<std::string>{"/other"});
  EXPECT_TRUE(facts.known);
}

TEST(TopicFacts, KnowNothingWithoutAMaster) {
  const auto topics = publishedTopics();
  EXPECT_FALSE(topics);
  const TopicFacts facts = topicFacts(topics, "/depth", kImage);
  EXPECT_FALSE(facts.known);
  EXPECT_EQ(facts.type, "");
  EXPECT_TRUE(facts.others.empty()) << "none of it is a topic to remap to";
}

TEST(TopicFacts, ATransportsTopicIsAnotherOne) {
  const auto typeOf = [](const char* name, const char* transport_topic) {
    TopicFacts facts = topicFacts(published(), name, kImage);
    takeTransport(published(), transport_topic, facts);
    return facts.type;
  };
  EXPECT_EQ(typeOf("/packed", "/packed/compressedDepth"), kImage);
  EXPECT_EQ(typeOf("/depth", "/depth/compressedDepth"), "") << "that one nobody publishes";
  EXPECT_EQ(typeOf("/depth", "/depth"), kImage) << "raw";
  EXPECT_EQ(typeOf("/depth", ""), kImage) << "not subscribed";
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  setenv("ROS_MASTER_URI", "http://localhost:1", 1);
  ros::init(argc, argv, "topic_facts_test");
  return RUN_ALL_TESTS();
}
