#include "bag_facts.h"

#include <image_transport/camera_common.h>

#include <map>
#include <stdexcept>
#include <vector>

#include "bag_topics.h"
#include "doctor/topic_advice.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kImage = "sensor_msgs/Image";
constexpr const char* kCloud = "sensor_msgs/PointCloud2";
constexpr const char* kInfo = "sensor_msgs/CameraInfo";
constexpr const char* kPacked = "sensor_msgs/CompressedImage";

using Types = std::map<std::string, std::string>;

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

std::string onlyOne(const std::vector<std::string>& topics, const char* what) {
  if (topics.size() == 1) return topics.front();
  throw std::runtime_error("there are several " + std::string(what) +
                           " topics, choose one with --topic: " + listed(topics));
}

/// @return the topic that can only be meant, even where it is of a wrong type; or none.
std::string chooseTopic(const rosbag::Bag& bag, const Types& types, bool points) {
  std::vector<std::string> clouds, named;
  for (const auto& [topic, type] : types) {
    if (type == kCloud) clouds.push_back(topic);
    const bool any = type == kImage || type == kCloud;
    if (any && contains(topic, "depth") && contains(topic, "image")) named.push_back(topic);
  }
  const auto depth = depthTopics(bag);
  const std::vector<std::string> images(depth.begin(), depth.end());
  if (points && !clouds.empty()) return onlyOne(clouds, "cloud");
  if (!images.empty()) return onlyOne(images, "depth");
  return named.size() == 1 ? named.front() : "";
}

/// @param depth topic that is wanted; empty: any.
/// @return a topic of packed depth, as of image_transport's compressedDepth, or none.
std::string packedDepth(const Types& types, const std::string& depth) {
  std::string packed;
  for (const auto& [topic, type] : types) {
    const bool meant = depth.empty() || topic == depth || topic.rfind(depth + "/", 0) == 0;
    if (type != kPacked || !meant || !contains(topic, "depth")) continue;
    if (packed.empty() || contains(topic, "/compressedDepth")) packed = topic;
  }
  return packed;
}

void addOthers(const Types& types, InputFacts& facts) {
  for (const auto& [topic, type] : types) {
    if (topic == facts.depth.name) continue;
    if (facts.depth.type.empty()) {
      facts.depth.others.push_back(topic + " (" + type + ")");
    } else if (type == facts.depth.expected_type) {
      facts.depth.others.push_back(topic);
    }
    if (type == kInfo) facts.info.others.push_back(topic);
  }
}

}  // namespace

InputFacts bagFacts(const rosbag::Bag& bag, const DoctorSettings& settings,
                    const RecordingOptions& options) {
  const Types types = topicTypes(bag);
  const auto typeOf = [&](const std::string& topic) {
    return types.count(topic) == 0 ? "" : types.at(topic);
  };
  InputFacts facts;
  facts.live = false;
  facts.from_points = settings.points;
  facts.depth.name =
      options.topic.empty() ? chooseTopic(bag, types, settings.points) : options.topic;
  facts.depth.expected_type = settings.points ? kCloud : kImage;
  facts.depth.type = typeOf(facts.depth.name);
  if (!settings.points) facts.depth.packed = packedDepth(types, facts.depth.name);
  addOthers(types, facts);
  if (settings.points || options.camera || facts.depth.name.empty()) return facts;
  facts.info.name = image_transport::getCameraInfoTopic(facts.depth.name);
  facts.info.type = typeOf(facts.info.name);
  return facts;
}

}  // namespace dominant_plane_detection
