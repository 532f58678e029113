#pragma once

#include <algorithm>
#include <chrono>

namespace dominant_plane_detection {

/// When to look for a camera again: soon, less and less often while there is none, at once when one
/// is plugged in, and with patience for one that goes as soon as it comes.
class ReconnectPolicy {
 public:
  using Clock = std::chrono::steady_clock;
  using Duration = std::chrono::milliseconds;

  /// @param wait before the second look; it doubles each time up to five seconds.
  explicit ReconnectPolicy(Duration wait = kShortest) : wait_(wait), back_off_(wait) {}

  bool due(Clock::time_point now) const { return now >= next_; }

  /// @param begin of the search: a camera that was plugged in since then is looked for at once.
  void searchedInVain(Clock::time_point begin, Clock::time_point now) {
    if (arrived_ >= begin) return;
    next_ = now + back_off_;
    back_off_ = std::min(2 * back_off_, std::max(kLongest, wait_));
  }
  void opened(Clock::time_point now) {
    opened_ = now;
    back_off_ = wait_;
  }
  void lost(Clock::time_point now) {
    const bool healthy = now - opened_ > kHealthy;
    penalty_ = healthy ? Duration::zero() : std::clamp(2 * penalty_, kShortest, kLongest);
    earliest_ = now + penalty_;
    next_ = std::max(earliest_, now + wait_);
  }
  /// Some camera was plugged in.
  void arrived(Clock::time_point now) {
    arrived_ = now;
    next_ = std::max(earliest_, now);
  }

 private:
  static constexpr Duration kShortest{250};
  static constexpr Duration kLongest{5000};
  static constexpr Duration kHealthy{5000};  ///< a camera that stayed so long gets a fresh start

  Duration wait_;
  Clock::time_point next_;      ///< look
  Clock::time_point earliest_;  ///< look, whatever is plugged in
  Clock::time_point opened_;
  Clock::time_point arrived_;
  Duration back_off_;
  Duration penalty_{0};
};

}  // namespace dominant_plane_detection
