#pragma once

#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <future>
#include <map>
#include <string>
#include <vector>

namespace dominant_plane_detection {

/// @return [-] by how much longer than usual to wait, from the environment's DPD_PATIENCE: programs
/// with a sanitizer are slow.
inline double patience() {
  const char* factor = std::getenv("DPD_PATIENCE");
  return factor == nullptr ? 1.0 : std::atof(factor);
}

/// Handles callbacks until a condition holds.
/// @return false when it still does not after `seconds` of wall time.
inline bool spinUntil(const std::function<bool()>& condition, double seconds = 20.0) {
  const ros::SteadyTime end = ros::SteadyTime::now() + ros::WallDuration(patience() * seconds);
  while (!condition()) {
    if (ros::SteadyTime::now() > end || !ros::ok()) return false;
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
  }
  return true;
}

/// @return whether the other thread has its result.
template <typename Result>
bool isReady(const std::future<Result>& result) {
  return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

/// Keeps every message of a topic.
template <typename Message>
class Listener {
 public:
  Listener(ros::NodeHandle& node, const std::string& topic) {
    subscriber_ = node.subscribe<Message>(
        topic, 1000,
        [this](const boost::shared_ptr<const Message>& message) { messages_.push_back(message); });
  }
  bool connected() const { return subscriber_.getNumPublishers() > 0; }
  std::size_t size() const { return messages_.size(); }
  const std::vector<boost::shared_ptr<const Message>>& messages() const { return messages_; }
  boost::shared_ptr<const Message> last() const { return messages_.back(); }

 private:
  ros::Subscriber subscriber_;
  std::vector<boost::shared_ptr<const Message>> messages_;
};

}  // namespace dominant_plane_detection
