#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

namespace dominant_plane_detection::virtual_kinect {

/// Calls functions later, one after the other, in a thread of its own.
class Scheduler {
 public:
  using Steady = std::chrono::steady_clock;

  Scheduler();
  /// Forgets what has not been called; waits for what is being called.
  ~Scheduler();

  /// @param delay [s]
  void after(double delay, std::function<void()> function);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::multimap<Steady::time_point, std::function<void()>> waiting_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace dominant_plane_detection::virtual_kinect
