#include "detection_status.h"

#include <algorithm>

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
    said_["/" + status.name.substr(0, colon)].push_back({status.level, status.message, values});
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

std::string DetectionStatus::valueOf(const Status& status, const std::string& key) {
  const auto value = status.values.find(key);
  return value == status.values.end() ? "" : value->second;
}

std::size_t DetectionStatus::countOf(const Status& status, const std::string& key) {
  const std::string text = valueOf(status, key);
  return text.empty() ? 0 : std::stoul(text);
}

std::string DetectionStatus::value(const std::string& node, const std::string& key) const {
  return count(node) == 0 ? "" : valueOf(said_.at(node).back(), key);
}

std::string DetectionStatus::lasting(const std::string& node, const std::string& key) const {
  const std::size_t times = count(node);
  if (times < 2 || valueOf(said_.at(node)[times - 2], key).empty()) return "";
  return value(node, key);
}

std::string DetectionStatus::lastSaid(const std::string& node, const std::string& key) const {
  if (count(node) == 0) return "";
  const std::vector<Status>& said = said_.at(node);
  const auto last = std::find_if(said.rbegin(), said.rend(), [&](const Status& status) {
    return !valueOf(status, key).empty();
  });
  return last == said.rend() ? "" : valueOf(*last, key);
}

std::size_t DetectionStatus::growth(const std::string& node, const std::string& key) const {
  if (count(node) == 0) return 0;
  const std::size_t first = countOf(said_.at(node).front(), key);
  const std::size_t last = countOf(said_.at(node).back(), key);
  return last < first ? last : last - first;
}

std::string DetectionStatus::lastingError(const std::string& node) const {
  const std::size_t times = count(node);
  if (times < 2) return "";
  const auto is_error = [](const Status& status) {
    return status.level == diagnostic_msgs::DiagnosticStatus::ERROR;
  };
  const std::vector<Status>& said = said_.at(node);
  return is_error(said[times - 1]) && is_error(said[times - 2]) ? said.back().message : "";
}

}  // namespace dominant_plane_detection
