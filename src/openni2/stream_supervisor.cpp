#include "openni2/stream_supervisor.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>

namespace dominant_plane_detection {
namespace {

using std::chrono::milliseconds;

// Between attempts to start a stream that does not.
constexpr milliseconds kShortestBackOff{250};
constexpr milliseconds kLongestBackOff{8000};

/// @return [-] of the patience with a stream that was started anew so often without an image.
double backOffFactor(int restarts) {
  constexpr int kMost = 6;
  return std::exp2(std::clamp(restarts, 0, kMost));
}

}  // namespace

void StreamSupervisor::beginAnew() {
  restarts_in_a_row_ = 0;
  last_problem_.clear();
  back_off_ = milliseconds(0);
  tryAgain();
}

void StreamSupervisor::follow(CameraDevice& camera, const CameraSettings& settings,
                              const Demand& demand) {
  if (!demand.wanted) {
    if (camera.has(kind_)) camera.stream(kind_).stop();
    beginAnew();
    report(StreamState::kIdle, "nobody listens");
  } else if (!camera.has(kind_)) {
    fail(camera, std::string("the camera has no ") + toString(kind_) + " stream");
  } else if (camera.stream(kind_).running()) {
    watch(camera, settings, demand);
  } else if (Clock::now() >= next_start_) {
    start(camera, settings);
  }
}

void StreamSupervisor::start(CameraDevice& camera, const CameraSettings& settings) {
  try {
    camera.start(kind_, settings);
    report(StreamState::kStarting, "starting");
  } catch (const std::exception& error) {
    fail(camera, std::string("the ") + toString(kind_) + " stream does not start: " + error.what());
  }
}

void StreamSupervisor::watch(CameraDevice& camera, const CameraSettings& settings,
                             const Demand& demand) {
  SensorStream& stream = camera.stream(kind_);
  if (stream.silence() < demand.patience) {
    if (!stream.heard()) return;
    beginAnew();
    return report(StreamState::kStreaming, "streaming");
  }
  if (camera.isRecording()) {
    return settings.repeat ? report(StreamState::kSilent, "the recording is silent")
                           : report(StreamState::kFinished, "the recording has come to its end");
  }
  report(StreamState::kSilent, std::string("no ") + toString(kind_) + " image for too long");
  // Where other streams run, reopening the camera would do more harm than good: this one is started
  // less and less often.
  const int beyond = restarts_in_a_row_ - kRestarts;
  if (demand.others_run && stream.silence() < demand.patience * backOffFactor(beyond)) return;
  ++restarts_in_a_row_;
  if (isHopeless() && !demand.others_run) return;
  ++status_.restarts;
  ROS_WARN_STREAM(describe(camera.description())
                  << ": " << status_.text << "; the stream is started anew.");
  stream.stop();
  const StreamStatus silent = status_;
  start(camera, settings);
  // Until it gives an image it stays what it was.
  if (status_.state == StreamState::kStarting) report(silent.state, silent.text);
}

void StreamSupervisor::fail(const CameraDevice& camera, const std::string& problem) {
  report(StreamState::kFailed, problem);
  back_off_ = std::clamp(2 * back_off_, kShortestBackOff, kLongestBackOff);
  next_start_ = Clock::now() + back_off_;
  if (problem == last_problem_) return;
  last_problem_ = problem;
  ROS_ERROR_STREAM(describe(camera.description()) << ": " << problem << ".");
}

void StreamSupervisor::report(StreamState state, const std::string& text) {
  status_.state = state;
  status_.text = text;
}

}  // namespace dominant_plane_detection
