#include "openni2/device_session.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>

#include "openni2/camera_choice.h"
#include "openni2/lasting_threads.h"

namespace dominant_plane_detection {
namespace {

constexpr double kShortestBackOff = 0.25;  // [s]
constexpr double kLongestBackOff = 5.0;    // [s]
constexpr double kHealthy = 5.0;           // [s] a camera that stayed so long gets a fresh start
constexpr double kStep = 0.1;              // [s] between looks at the streams
constexpr double kReading = 1.0 / 30.0;    // [s] between readings of the accelerometer
constexpr int kRestarts = 3;               // [#] of a silent stream until the camera is reopened

/// @return [-] of the patience with a stream that was started anew so often without a frame.
double backOffFactor(int restarts) {
  constexpr int kMost = 6;
  return std::exp2(std::clamp(restarts - kRestarts, 0, kMost));
}

std::chrono::steady_clock::duration seconds(double value) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(value));
}

}  // namespace

DeviceSession::DeviceSession(std::string device_id, const CameraSettings& settings, double patience,
                             Callbacks callbacks)
    : device_id_(std::move(device_id)),
      callbacks_(std::move(callbacks)),
      wish_(settings),
      back_off_(kShortestBackOff),
      patience_(patience) {
  report(SessionState::kSearching, "looking for " + device_id_);
  running_ = runInLastingThread([this] { run(); });
}

DeviceSession::~DeviceSession() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  running_.wait();
}

void DeviceSession::want(StreamKind kind, bool wanted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  wanted_[static_cast<std::size_t>(kind)] = wanted;
  poked_ = true;
  changed_.notify_all();
}

void DeviceSession::wantAcceleration(bool wanted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  acceleration_wanted_ = wanted;
  poked_ = true;
  changed_.notify_all();
}

std::string DeviceSession::apply(const CameraSettings& settings) {
  const std::lock_guard<std::mutex> one_at_a_time(applying_);
  std::future<std::string> answer;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (ending_) return "the driver is being unloaded";
    change_.emplace();
    change_->settings = settings;
    answer = change_->answer.get_future();
    changed_.notify_all();
  }
  return answer.get();
}

void DeviceSession::setPatience(double seconds) {
  const std::lock_guard<std::mutex> lock(mutex_);
  patience_ = seconds;
}

SessionStatus DeviceSession::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

void DeviceSession::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ending_) {
    poked_ = false;
    std::optional<Change> change = std::exchange(change_, std::nullopt);
    lock.unlock();
    try {
      if (change) makeChange(*change);
      step();
    } catch (const std::exception& error) {
      disconnect(error.what());
    }
    lock.lock();
    changed_.wait_for(lock, seconds(pause()), [this] { return ending_ || poked_ || change_; });
  }
  if (change_) change_->answer.set_value("the driver is being unloaded");
  lock.unlock();
  if (listener_ != 0) runtime_->removeListener(listener_);
  camera_.reset();
  runtime_.reset();
}

void DeviceSession::step() {
  bool gone = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    gone = std::exchange(gone_, false);
  }
  if (camera_ && gone) disconnect("it was unplugged");
  if (!camera_ && timeToSearch()) search();
  if (!camera_) return;
  startAndStop();
  watch();
  if (camera_) readAcceleration();
}

bool DeviceSession::timeToSearch() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return Steady::now() >= next_search_;
}

double DeviceSession::pause() const { return acceleration_wanted_ ? kReading : kStep; }

void DeviceSession::readAcceleration() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!acceleration_wanted_) return;
  }
  if (!camera_->hasAccelerometer()) return;
  const auto acceleration = camera_->acceleration();
  if (acceleration) callbacks_.acceleration(*acceleration);
}

void DeviceSession::search() {
  std::string problem;
  try {
    if (!runtime_) {
      runtime_ = OpenNi2Runtime::instance();
      listener_ = runtime_->addListener([this](const std::string& gone) { onDeviceEvent(gone); });
    }
    // The serial number finds a camera again wherever it is plugged in.
    const bool in_list = !namesItself(device_id_);
    const std::string& id = in_list && !serial_.empty() ? serial_ : device_id_;
    const CameraChoice choice =
        chooseCamera(id, in_list ? runtime_->cameras() : std::vector<CameraDescription>());
    if (choice.uri.empty()) {
      problem = choice.error;
    } else {
      connect(choice.uri);
    }
  } catch (const std::exception& error) {
    camera_.reset();
    problem = error.what();
  }
  if (camera_) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    next_search_ = Steady::now() + seconds(back_off_);
  }
  back_off_ = std::min(2.0 * back_off_, kLongestBackOff);
  report(SessionState::kSearching, problem);
  if (problem != said_) ROS_WARN_STREAM("Waiting for a camera: " << problem << ".");
  said_ = problem;
}

void DeviceSession::connect(const std::string& uri) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    open_uri_ = uri;
    gone_ = false;
  }
  camera_ = std::make_unique<CameraDevice>(runtime_, uri, callbacks_.frame);
  serial_ = camera_->description().serial;
  opened_ = Steady::now();
  said_.clear();
  said_of_stream_.fill("");
  restarts_in_a_row_.fill(0);
  const std::string refusal = camera_->refusal(wish_);
  settings_ = camera_->possible(wish_);
  if (!refusal.empty()) {
    ROS_ERROR_STREAM("Refused settings of " << describe(camera_->description()) << ": " << refusal
                                            << "; what it does by itself is used.");
  }
  camera_->apply(settings_);
  back_off_ = kShortestBackOff;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    status_.camera = camera_->description();
    ++status_.connections;
  }
  report(SessionState::kIdle, "open");
  ROS_INFO_STREAM("Opened " << describe(camera_->description()) << ".");
  callbacks_.opened(*camera_);
}

void DeviceSession::disconnect(const std::string& why) {
  if (!camera_) return;
  ROS_WARN_STREAM("Lost " << describe(camera_->description()) << ": " << why << ".");
  camera_.reset();
  const bool healthy = Steady::now() - opened_ > seconds(kHealthy);
  penalty_ = healthy ? 0.0 : std::clamp(2.0 * penalty_, kShortestBackOff, kLongestBackOff);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    open_uri_.clear();
    status_.camera = CameraDescription();
    earliest_search_ = Steady::now() + seconds(penalty_);
    next_search_ = std::max(earliest_search_, Steady::now() + seconds(kShortestBackOff));
  }
  report(SessionState::kSearching, "lost: " + why);
}

void DeviceSession::onDeviceEvent(const std::string& gone) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (gone.empty()) {
    // One that came is worth a look at once, unless it keeps coming and going.
    next_search_ = std::max(earliest_search_, Steady::now());
  } else if (gone == open_uri_) {
    gone_ = true;
  } else {
    return;
  }
  poked_ = true;
  changed_.notify_all();
}

void DeviceSession::makeChange(Change& change) {
  std::string error;
  try {
    error = changeTo(change.settings);
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  change.answer.set_value(error);
}

std::string DeviceSession::changeTo(const CameraSettings& settings) {
  if (!camera_) {
    wish_ = settings;
    return "";
  }
  const std::string refusal = camera_->refusal(settings);
  if (!refusal.empty()) return refusal;
  wish_ = settings;
  const CameraSettings old = std::exchange(settings_, settings);
  const bool other_depth = old.depth_registration != settings.depth_registration ||
                           old.raw_disparity != settings.raw_disparity;
  const auto other = [&](StreamKind kind) {
    return !(old.mode(kind) == settings.mode(kind)) || (other_depth && kind == StreamKind::kDepth);
  };
  for (const StreamKind kind : kAllStreams) {
    if (camera_->has(kind) && other(kind)) camera_->stream(kind).stop();
  }
  camera_->apply(settings);
  startAndStop();
  for (const StreamKind kind : kAllStreams) {
    const bool failed = camera_->has(kind) && wanted(kind) && !camera_->stream(kind).running();
    if (!failed || !other(kind)) continue;
    wish_ = settings_ = old;
    camera_->apply(old);
    return said_of_stream_[static_cast<std::size_t>(kind)];
  }
  return "";
}

void DeviceSession::startAndStop() {
  for (const StreamKind kind : kAllStreams) {
    if (!camera_->has(kind) || wanted(kind)) continue;
    if (camera_->stream(kind).running()) camera_->stream(kind).stop();
    said_of_stream_[static_cast<std::size_t>(kind)].clear();
  }
  for (const StreamKind kind : kAllStreams) {
    if (wanted(kind)) startWanted(kind);
  }
}

void DeviceSession::startWanted(StreamKind kind) {
  std::string problem;
  if (!camera_->has(kind)) {
    problem = std::string("the camera has no ") + toString(kind) + " stream";
  } else if (!camera_->stream(kind).running()) {
    try {
      camera_->start(kind, settings_);
    } catch (const std::exception& error) {
      problem = std::string("the ") + toString(kind) + " stream does not start: " + error.what();
    }
  }
  std::string& said = said_of_stream_[static_cast<std::size_t>(kind)];
  if (!problem.empty() && problem != said) {
    ROS_ERROR_STREAM(describe(camera_->description()) << ": " << problem << ".");
  }
  said = problem;
}

void DeviceSession::watch() {
  double patience = 0.0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    patience = patience_;
  }
  SessionState state = SessionState::kIdle;
  std::string text = "nobody listens";
  for (const StreamKind kind : kAllStreams) {
    if (!camera_->has(kind) || !camera_->stream(kind).running()) continue;
    SensorStream& stream = camera_->stream(kind);
    int& restarts = restarts_in_a_row_[static_cast<std::size_t>(kind)];
    if (stream.silence() < patience) {
      if (state == SessionState::kIdle) {
        state = SessionState::kStreaming;
        text = "streaming";
      }
      if (stream.heard()) restarts = 0;
      continue;
    }
    if (camera_->isRecording()) {
      state = settings_.repeat ? SessionState::kSilent : SessionState::kFinished;
      text = settings_.repeat ? "the recording is silent" : "the recording has come to its end";
      continue;
    }
    state = SessionState::kSilent;
    text = std::string("no ") + toString(kind) + " image for too long";
    // Where other streams run, reopening the camera would do more harm than good.
    const bool alone = !anyHeard(patience);
    if (!alone && stream.silence() < patience * backOffFactor(restarts)) continue;
    if (++restarts > kRestarts && alone) {
      disconnect(text + ", and starting the stream anew did not help");
      return;
    }
    ROS_WARN_STREAM(describe(camera_->description())
                    << ": " << text << "; the stream is started anew.");
    stream.stop();
    camera_->start(kind, settings_);
    const std::lock_guard<std::mutex> lock(mutex_);
    ++status_.restarts;
  }
  report(state, text);
}

bool DeviceSession::anyHeard(double patience) const {
  return std::any_of(kAllStreams, kAllStreams + kStreamKinds, [&](StreamKind kind) {
    if (!camera_->has(kind)) return false;
    const SensorStream& stream = camera_->stream(kind);
    return stream.running() && stream.heard() && stream.silence() < patience;
  });
}

void DeviceSession::report(SessionState state, const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.state = state;
  status_.text = text;
}

bool DeviceSession::wanted(StreamKind kind) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return wanted_[static_cast<std::size_t>(kind)];
}

}  // namespace dominant_plane_detection
