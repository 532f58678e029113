#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "openni2/camera_device.h"

namespace dominant_plane_detection {

enum class StreamState : std::uint8_t {
  kIdle,       ///< nobody wants its images
  kStarting,   ///< started, no image yet
  kStreaming,  ///< images come
  kSilent,     ///< images should come
  kFailed,     ///< it does not start
  kFinished,   ///< the recording has come to its end
};

struct StreamStatus {
  StreamState state = StreamState::kIdle;
  std::string text = "nobody listens";  ///< one sentence, or a part of one
  int restarts = 0;                     ///< [#] of times that it was silent and started anew, ever
};

/// Keeps one stream of an open camera as it is wanted: starts and stops it, starts it anew when it
/// falls silent. What goes wrong with one stream is no other's concern. Of the session's thread.
class StreamSupervisor {
 public:
  struct Demand {
    bool wanted;
    double patience;  ///< [s] without an image until it is started anew
    bool others_run;  ///< other streams of the camera run and are not silent
  };

  explicit StreamSupervisor(StreamKind kind) : kind_(kind) {}

  /// Another camera was opened.
  void beginAnew();
  /// What did not start may do so now: other streams ended, or settings changed.
  void tryAgain() { next_start_ = Clock::time_point(); }

  /// Never throws: that a stream does not start is part of its status, and of the log.
  void follow(CameraDevice& camera, const CameraSettings& settings, const Demand& demand);

  const StreamStatus& status() const { return status_; }
  /// @return whether starting it anew was of no use, so that the camera had better be reopened.
  bool isHopeless() const { return restarts_in_a_row_ > kRestarts; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int kRestarts = 3;  ///< [#] without an image in between

  void start(CameraDevice& camera, const CameraSettings& settings);
  void watch(CameraDevice& camera, const CameraSettings& settings, const Demand& demand);
  void fail(const CameraDevice& camera, const std::string& problem);
  void report(StreamState state, const std::string& text);

  StreamKind kind_;
  StreamStatus status_;
  int restarts_in_a_row_ = 0;
  std::string last_problem_;  ///< that the log has
  Clock::time_point next_start_;
  std::chrono::milliseconds back_off_{0};
};

}  // namespace dominant_plane_detection
