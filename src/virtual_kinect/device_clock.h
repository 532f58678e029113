#pragma once

#include <chrono>
#include <mutex>

namespace dominant_plane_detection::virtual_kinect {

/// A device's own clock, which may go wrong.
class DeviceClock {
 public:
  using Steady = std::chrono::steady_clock;

  /// @param drift [-] by which it is fast.
  explicit DeviceClock(double drift) : begin_(Steady::now()), drift_(drift) {}

  /// The clock goes on from where it is at another rate.
  void setDrift(double drift) {
    const auto now = Steady::now();
    const std::lock_guard<std::mutex> lock(mutex_);
    shown_ = show(now);
    begin_ = now;
    drift_ = drift;
  }

  /// @return [us] what the clock shows at a time.
  double at(Steady::time_point time) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return show(time);
  }

 private:
  double show(Steady::time_point time) const {
    const std::chrono::duration<double, std::micro> passed = time - begin_;
    return shown_ + passed.count() * (1.0 + drift_);
  }

  mutable std::mutex mutex_;
  Steady::time_point begin_;
  double shown_ = 0.0;  ///< [us] at begin_
  double drift_ = 0.0;
};

}  // namespace dominant_plane_detection::virtual_kinect
