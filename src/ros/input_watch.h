#pragma once

#include <optional>

namespace dominant_plane_detection {

/// Tells when an input is silent, or gives nothing that can be used. Times are of any steady clock.
class InputWatch {
 public:
  enum class Problem {
    kNone,
    kSilence,    ///< no image comes
    kUnmatched,  ///< images come, but for none of them a camera_info
  };
  static constexpr double kPatience = 5.0;  ///< [s] for which that is nothing to speak of

  /// @param now [s] when the input was subscribed.
  explicit InputWatch(double now = 0.0) : last_image_(now), last_match_(now) {}

  void sawImage(double now) {
    // The wait for a camera_info begins with the first image after a silence.
    if (now - last_image_ > kPatience) last_match_ = now;
    last_image_ = now;
  }
  /// An image was handed on, with its camera.
  void sawMatch(double now) { last_match_ = now; }

  Problem problem(double now) const {
    if (now - last_image_ > kPatience) return Problem::kSilence;
    return now - last_match_ > kPatience ? Problem::kUnmatched : Problem::kNone;
  }

 private:
  double last_image_;
  double last_match_;
};

}  // namespace dominant_plane_detection
