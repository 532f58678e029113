// What somebody asks of a session and waits for.

#include <ros/console.h>

#include <utility>

#include "openni2/device_session.h"

namespace dominant_plane_detection {

std::string DeviceSession::apply(const CameraSettings& settings) {
  return ask([this, settings] { return changeTo(settings); });
}

std::string DeviceSession::reset() {
  return ask([this] { return reopen(); });
}

std::string DeviceSession::ask(std::function<std::string()> change) {
  const std::lock_guard<std::mutex> one_at_a_time(applying_);
  std::future<std::string> answer;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (ending_) return kUnloading;
    change_.emplace();
    change_->make = std::move(change);
    answer = change_->answer.get_future();
    changed_.notify_all();
  }
  return answer.get();
}

void DeviceSession::makeChange(Change& change) {
  std::string error;
  try {
    error = change.make();
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  change.answer.set_value(error);
}

std::string DeviceSession::changeTo(const CameraSettings& settings) {
  if (!camera_) {
    requested_ = settings;
    return "";
  }
  // What it could not do before, and does not have to do now, refuses nothing else.
  std::string refusal = camera_->refusal(settings);
  if (!refusal.empty() && refusal != camera_->refusal(requested_)) return refusal;
  const CameraSettings old = settings_;
  const bool other_depth = old.depth_registration != settings.depth_registration ||
                           old.raw_disparity != settings.raw_disparity;
  const auto changes = [&](StreamKind kind) {
    return !(old.mode(kind) == settings.mode(kind)) || (other_depth && kind == StreamKind::kDepth);
  };
  const auto restartWith = [&](const CameraSettings& with) {
    for (const StreamKind kind : kAllStreams) {
      if (!changes(kind)) continue;
      if (camera_->has(kind)) camera_->stream(kind).stop();
      supervisor(kind).tryAgain();
    }
    settings_ = with;
    const std::string problem = camera_->apply(settings_);
    if (problem.empty()) followDemand();
    return problem;
  };
  refusal = restartWith(camera_->possible(settings));
  if (!camera_) return "the camera was lost meanwhile";
  for (const StreamKind kind : kAllStreams) {
    const StreamStatus& status = supervisor(kind).status();
    const bool failed = camera_->has(kind) && changes(kind) && status.state == StreamState::kFailed;
    if (refusal.empty() && failed) refusal = status.text;
  }
  if (refusal.empty()) {
    requested_ = settings;
  } else {
    restartWith(old);
  }
  return refusal;
}

std::string DeviceSession::reopen() {
  if (camera_) {
    ROS_INFO_STREAM("Closing " << describe(camera_->description())
                               << " to open it again, as it was asked for.");
    close("reset, as it was asked for");
  }
  search();
  return camera_ ? "" : status().problem;
}

}  // namespace dominant_plane_detection
