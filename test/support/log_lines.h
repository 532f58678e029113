#pragma once

#include <ros/console.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

namespace dominant_plane_detection {

/// Keeps what this process writes to the log, from now on.
class LogLines : public ros::console::LogAppender {
 public:
  LogLines() { ros::console::register_appender(this); }
  ~LogLines() override { ros::console::deregister_appender(this); }

  void log(ros::console::Level level, const char* text, const char* /*file*/,
           const char* /*function*/, int /*line*/) override {
    if (level < ros::console::levels::Warn) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    lines_.emplace_back(text);
  }
  /// @return [#] of warnings and errors with a text in them.
  std::size_t count(const std::string& text) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return static_cast<std::size_t>(std::count_if(
        lines_.begin(), lines_.end(),
        [&](const std::string& line) { return line.find(text) != std::string::npos; }));
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

}  // namespace dominant_plane_detection
