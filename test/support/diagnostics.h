#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include <optional>
#include <string>

#include "support/ros_test.h"

namespace dominant_plane_detection {

/// What /diagnostics says, from now on.
class Diagnostics {
 public:
  explicit Diagnostics(ros::NodeHandle& node) : listener_(node, "/diagnostics") {}

  /// @param name of a status, such as "camera/driver: depth".
  /// @return the latest.
  std::optional<diagnostic_msgs::DiagnosticStatus> of(const std::string& name) const {
    const auto& arrays = listener_.messages();
    for (auto array = arrays.rbegin(); array != arrays.rend(); ++array) {
      for (const auto& status : (*array)->status) {
        if (status.name == name) return status;
      }
    }
    return std::nullopt;
  }
  /// Waits until the latest status of a name has a level and a text in its message.
  bool waitFor(const std::string& name, int level, const std::string& text, double seconds = 20.0) {
    return spinUntil(
        [&] {
          const auto status = of(name);
          return status && status->level == level && contains(status->message, text);
        },
        seconds);
  }
  /// @return one of a status's values; empty if it has none of that key.
  std::string value(const std::string& name, const std::string& key) const {
    const auto status = of(name);
    if (!status) return "";
    for (const auto& pair : status->values) {
      if (pair.key == key) return pair.value;
    }
    return "";
  }
  /// @return the latest message of a status, for when a test fails.
  std::string message(const std::string& name) const {
    const auto status = of(name);
    return status ? std::to_string(status->level) + " " + status->message : "(none)";
  }

 private:
  static bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  Listener<diagnostic_msgs::DiagnosticArray> listener_;
};

}  // namespace dominant_plane_detection
