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
  explicit InputWatch(double now = 0.0) : last_image_(now) {}

  void sawImage(double now) {
    // The wait for a camera_info begins with the first image that has none, or the first after a
    // silence.
    if (!unmatched_since_ || now - last_image_ > kPatience) unmatched_since_ = now;
    last_image_ = now;
  }
  /// An image was handed on, with its camera.
  void sawMatch() { unmatched_since_.reset(); }

  Problem problem(double now) const {
    if (now - last_image_ > kPatience) return Problem::kSilence;
    const bool unmatched = unmatched_since_ && now - *unmatched_since_ > kPatience;
    return unmatched ? Problem::kUnmatched : Problem::kNone;
  }

 private:
  double last_image_;
  std::optional<double> unmatched_since_;  ///< while no image has found its camera_info
};

}  // namespace dominant_plane_detection
