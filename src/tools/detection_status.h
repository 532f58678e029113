#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/node_handle.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace dominant_plane_detection {

/// What the detections that run say of themselves in /diagnostics; inside a manager they do not
/// show otherwise.
class DetectionStatus {
 public:
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
  /// @return the last that is not empty, or nothing.
  std::string lastSaid(const std::string& node, const std::string& key) const;
  /// @return [#] by how much a count grew while it was listened to, or since it began anew.
  std::size_t growth(const std::string& node, const std::string& key) const;
  /// @return its message where it was an error the last two times, or nothing.
  std::string lastingError(const std::string& node) const;

 private:
  using Values = std::map<std::string, std::string>;
  struct Status {
    int level;
    std::string message;
    Values values;
  };

  void onDiagnostics(const diagnostic_msgs::DiagnosticArray& array);
  static std::string valueOf(const Status& status, const std::string& key);
  static std::size_t countOf(const Status& status, const std::string& key);

  std::map<std::string, std::vector<Status>> said_;  ///< by node, oldest first
  ros::Subscriber subscriber_;
};

}  // namespace dominant_plane_detection
