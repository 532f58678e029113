#include "openni2/device_session.h"

#include <ros/console.h>

#include <algorithm>
#include <utility>

#include "openni2/camera_choice.h"
#include "openni2/lasting_threads.h"

namespace dominant_plane_detection {
namespace {

constexpr std::chrono::milliseconds kStep{100};    // between looks at the streams
constexpr std::chrono::milliseconds kReading{33};  // between readings of accelerometer and motor

}  // namespace

DeviceSession::DeviceSession(std::string device_id, const CameraSettings& settings, double patience,
                             Callbacks callbacks, const ReconnectPolicy& reconnect)
    : device_id_(std::move(device_id)),
      callbacks_(std::move(callbacks)),
      requested_(settings),
      reconnect_(reconnect) {
  demand_.patience = patience;
  status_.problem = "looking for " + device_id_;
  running_ = runInLastingThread([this] { run(); });
}

DeviceSession::~DeviceSession() { end(); }

void DeviceSession::end() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  running_.wait();
}

void DeviceSession::want(StreamKind kind, bool wanted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (std::exchange(demand_.streams[static_cast<std::size_t>(kind)], wanted) == wanted) return;
  demand_changed_ = true;
  changed_.notify_all();
}

void DeviceSession::wantAcceleration(bool wanted) { want(&Demand::acceleration, wanted); }

void DeviceSession::wantTiltAngle(bool wanted) { want(&Demand::tilt_angle, wanted); }

void DeviceSession::want(bool Demand::*reading, bool wanted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (std::exchange(demand_.*reading, wanted) == wanted) return;
  demand_changed_ = true;
  changed_.notify_all();
}

void DeviceSession::order(const MotorOrders& orders) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (orders.tilt) orders_.tilt = orders.tilt;
  if (orders.led) orders_.led = orders.led;
  changed_.notify_all();
}

void DeviceSession::setPatience(double seconds) {
  const std::lock_guard<std::mutex> lock(mutex_);
  demand_.patience = seconds;
}

SessionStatus DeviceSession::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

DeviceSession::Demand DeviceSession::demand() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return demand_;
}

void DeviceSession::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ending_) {
    if (std::exchange(demand_changed_, false)) {
      for (StreamSupervisor& each : supervisors_) each.tryAgain();
    }
    std::optional<Change> change = std::exchange(change_, std::nullopt);
    lock.unlock();
    try {
      if (change) makeChange(*change);
      step();
    } catch (const std::exception& error) {
      disconnect(error.what());
    }
    publishStatus();
    lock.lock();
    changed_.wait_for(lock, demand_.acceleration || demand_.tilt_angle ? kReading : kStep, [this] {
      return ending_ || demand_changed_ || unplugged_ || change_ ||
             (status_.open && !orders_.empty());
    });
  }
  if (change_) change_->answer.set_value(kUnloading);
  lock.unlock();
  if (listener_ != 0) runtime_->removeListener(listener_);
  camera_.reset();
  runtime_.reset();
}

void DeviceSession::step() {
  bool unplugged = false, search_now = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    unplugged = std::exchange(unplugged_, false);
    search_now = reconnect_.due(Clock::now());
  }
  if (camera_ && unplugged) {
    disconnect("it was unplugged");
  } else if (!camera_ && search_now) {
    search();
  }
  if (camera_) followOrders();
  if (camera_) followDemand();
}

void DeviceSession::followOrders() {
  MotorOrders orders;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    orders = std::exchange(orders_, {});
  }
  motor_.follow(*camera_, orders);
}

void DeviceSession::search() {
  const Clock::time_point begin = Clock::now();
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
    reconnect_.searchedInVain(begin, Clock::now());
    status_.problem = problem;
  }
  if (problem != last_problem_) ROS_WARN_STREAM("Waiting for a camera: " << problem << ".");
  last_problem_ = problem;
}

void DeviceSession::connect(const std::string& uri) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    open_uri_ = uri;
    unplugged_ = false;
  }
  camera_ = std::make_unique<CameraDevice>(runtime_, uri, callbacks_.frame);
  serial_ = camera_->description().serial;
  last_problem_.clear();
  for (StreamSupervisor& each : supervisors_) each.beginAnew();
  settings_ = camera_->possible(requested_);
  std::string refusal = camera_->refusal(requested_);
  const std::string problem = camera_->apply(settings_);
  if (!problem.empty()) refusal += (refusal.empty() ? "" : "; ") + problem;
  if (!refusal.empty()) {
    ROS_ERROR_STREAM("Refused settings of " << describe(camera_->description()) << ": " << refusal
                                            << "; what it does by itself is used.");
  }
  motor_.begin();
  callbacks_.opened(*camera_);
  const bool accelerometer = camera_->hasAccelerometer(), motor = camera_->hasMotor();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    reconnect_.opened(Clock::now());
    status_.open = true;
    status_.problem.clear();
    status_.accelerometer = accelerometer;
    status_.motor = motor;
    status_.camera = camera_->description();
    ++status_.connections;
  }
  ROS_INFO_STREAM("Opened " << describe(camera_->description()) << ".");
}

void DeviceSession::disconnect(const std::string& why) {
  if (!camera_) return;
  ROS_WARN_STREAM("Lost " << describe(camera_->description()) << ": " << why << ".");
  close("lost: " + why);
  const std::lock_guard<std::mutex> lock(mutex_);
  reconnect_.lost(Clock::now());
}

/// @param problem why there is no camera then.
void DeviceSession::close(const std::string& problem) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    open_uri_.clear();
    status_.open = status_.accelerometer = status_.motor = false;
    status_.problem = problem;
    status_.camera = CameraDescription();
  }
  camera_.reset();
}

/// In OpenNI2's thread.
void DeviceSession::onDeviceEvent(const std::string& gone) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (gone.empty()) {
    reconnect_.arrived(Clock::now());
    demand_changed_ = true;
  } else if (gone == open_uri_) {
    unplugged_ = true;
  }
  changed_.notify_all();
}

/// @return whether another stream of the camera runs, and is not silent yet.
bool DeviceSession::othersRun(StreamKind kind, double patience) const {
  return std::any_of(kAllStreams, kAllStreams + kStreamKinds, [&](StreamKind other) {
    if (other == kind || !camera_->has(other)) return false;
    const SensorStream& stream = camera_->stream(other);
    return stream.running() && stream.silence() < patience;
  });
}

void DeviceSession::followDemand() {
  const Demand demand = this->demand();
  // Colour may have to end before infrared can begin.
  for (const bool wanted : {false, true}) {
    for (const StreamKind kind : kAllStreams) {
      if (demand.streams[static_cast<std::size_t>(kind)] != wanted) continue;
      StreamSupervisor& each = supervisor(kind);
      const bool others_run = othersRun(kind, demand.patience);
      each.follow(*camera_, settings_, {wanted, demand.patience, others_run});
      if (!each.isHopeless() || others_run) continue;
      return disconnect(each.status().text + ", and starting the stream anew did not help");
    }
  }
  read(demand);
}

void DeviceSession::read(const Demand& demand) {
  if (demand.acceleration && camera_->hasAccelerometer()) {
    const auto acceleration = camera_->acceleration();
    if (acceleration) callbacks_.acceleration(*acceleration);
  }
  if (demand.tilt_angle && camera_->hasMotor()) {
    const auto angle = camera_->tiltAngle();
    if (angle) callbacks_.tilt_angle(*angle);
  }
}

void DeviceSession::publishStatus() {
  std::array<StreamStatus, kStreamKinds> streams;
  for (const StreamKind kind : kAllStreams) {
    if (camera_) streams[static_cast<std::size_t>(kind)] = supervisor(kind).status();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.streams = streams;
}

}  // namespace dominant_plane_detection
