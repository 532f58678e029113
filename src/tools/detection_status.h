#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/node_handle.h>

#include <map>
#include <string>
#include <vector>

namespace dominant_plane_detection {

/// What the detections that run say of themselves in /diagnostics; inside a manager they do not
/// show otherwise.
class DetectionStatus {
 public:
  using Values = std::map<std::string, std::string>;

  explicit DetectionStatus(ros::NodeHandle& node);

  /// @return the nodes' names, as "/camera/plane_detection".
  std::vector<std::string> nodes() const;
  /// @return how often a node said something.
  std::size_t count(const std::string& node) const;
  /// @return what it said last; empty where it said nothing.
  std::string value(const std::string& node, const std::string& key) const;
  /// @return the same where it said it the last two times: at the start things come one after the
  /// other.
  std::string lasting(const std::string& node, const std::string& key) const;

 private:
  void onDiagnostics(const diagnostic_msgs::DiagnosticArray& array);
  static std::string valueOf(const Values& values, const std::string& key);

  std::map<std::string, std::vector<Values>> said_;  ///< by node, oldest first
  ros::Subscriber subscriber_;
};

}  // namespace dominant_plane_detection
