#include "detection_status.h"

#include "ros/diagnostic_keys.h"

namespace dominant_plane_detection {

DetectionStatus::DetectionStatus(ros::NodeHandle& node)
    : subscriber_(node.subscribe("/diagnostics", 100, &DetectionStatus::onDiagnostics, this)) {}

void DetectionStatus::onDiagnostics(const diagnostic_msgs::DiagnosticArray& array) {
  for (const auto& status : array.status) {
    const std::size_t colon = status.name.find(": detection");
    Values values;
    for (const auto& pair : status.values) values[pair.key] = pair.value;
    if (colon == std::string::npos || values.count(keys::kDepthTopic) == 0) continue;
    said_["/" + status.name.substr(0, colon)].push_back(values);
  }
}

std::vector<std::string> DetectionStatus::nodes() const {
  std::vector<std::string> names;
  for (const auto& [name, said] : said_) names.push_back(name);
  return names;
}

std::size_t DetectionStatus::count(const std::string& node) const {
  const auto said = said_.find(node);
  return said == said_.end() ? 0 : said->second.size();
}

std::string DetectionStatus::valueOf(const Values& values, const std::string& key) {
  const auto value = values.find(key);
  return value == values.end() ? "" : value->second;
}

std::string DetectionStatus::value(const std::string& node, const std::string& key) const {
  return count(node) == 0 ? "" : valueOf(said_.at(node).back(), key);
}

std::string DetectionStatus::lasting(const std::string& node, const std::string& key) const {
  const std::size_t times = count(node);
  if (times < 2 || valueOf(said_.at(node)[times - 2], key).empty()) return "";
  return value(node, key);
}

}  // namespace dominant_plane_detection
