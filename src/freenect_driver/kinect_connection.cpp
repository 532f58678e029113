#include "freenect_driver/kinect_connection.h"

#include <pthread.h>

#include <cmath>
#include <cstring>
#include <stdexcept>

#include "freenect_driver/optional_functions.h"

namespace dominant_plane_detection::freenect_driver {
namespace {

constexpr int kFailure = -1;
constexpr std::int8_t kNoAngle = -128;  // of a motor that moves
constexpr double kDegree = M_PI / 180.0;
constexpr int kInterrupted = -10;      // LIBUSB_ERROR_INTERRUPTED: by a signal, nothing is wrong
constexpr suseconds_t kWait = 10'000;  // [us] for events, until tasks are looked at again

}  // namespace

KinectConnection::KinectConnection(const KinectId& id, std::function<void()> lost)
    : on_lost_(std::move(lost)), thread_([this] { run(); }) {
  std::string problem;
  call([&] {
    try {
      open(id);
    } catch (const std::runtime_error& error) {
      problem = error.what();
    }
    return 0;
  });
  if (problem.empty()) return;
  close();
  throw std::runtime_error(problem);
}

KinectConnection::~KinectConnection() { close(); }

void KinectConnection::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void KinectConnection::open(const KinectId& id) {
  if (freenect_init(&context_, nullptr) < 0) {
    context_ = nullptr;
    throw std::runtime_error("libfreenect does not start");
  }
  freenect_set_log_level(context_, FREENECT_LOG_ERROR);
  // Later models have no motor, nor accelerometer, before their audio firmware is loaded.
  int status = openDevice(id, FREENECT_DEVICE_CAMERA | FREENECT_DEVICE_MOTOR);
  motor_ = status >= 0;
  if (status < 0) status = openDevice(id, FREENECT_DEVICE_CAMERA);
  if (status < 0) {
    throw std::runtime_error("libfreenect cannot open " + id.uri() + ", error " +
                             std::to_string(status) +
                             ": is it in use by another program or by the kernel module "
                             "gspca_kinect, and may this user open it (udev rule)?");
  }
  const OptionalFunctions& functions = optionalFunctions();
  if (motor_ && functions.enabled_subdevices != nullptr) {
    motor_ = (functions.enabled_subdevices(context_) & FREENECT_DEVICE_MOTOR) != 0;
  }
  freenect_set_user(device_, this);
  freenect_set_depth_callback(device_, [](freenect_device* device, void* data, std::uint32_t t) {
    auto& self = *static_cast<KinectConnection*>(freenect_get_user(device));
    self.deliver(self.depth_, data, t);
  });
  freenect_set_video_callback(device_, [](freenect_device* device, void* data, std::uint32_t t) {
    auto& self = *static_cast<KinectConnection*>(freenect_get_user(device));
    self.deliver(self.video_, data, t);
  });
  depth_.set_buffer = freenect_set_depth_buffer;
  depth_.stop = freenect_stop_depth;
  video_.set_buffer = freenect_set_video_buffer;
  video_.stop = freenect_stop_video;
  readTables();
}

int KinectConnection::openDevice(const KinectId& id, int subdevices) {
  freenect_select_subdevices(context_, static_cast<freenect_device_flags>(subdevices));
  return id.serial.empty()
             ? freenect_open_device(context_, &device_, id.index)
             : freenect_open_device_by_camera_serial(context_, &device_, id.serial.c_str());
}

void KinectConnection::readTables() {
  const OptionalFunctions& functions = optionalFunctions();
  if (functions.copy_registration == nullptr || functions.destroy_registration == nullptr) return;
  freenect_registration registration = functions.copy_registration(device_);
  if (registration.raw_to_mm_shift != nullptr && registration.depth_to_rgb_shift != nullptr &&
      registration.registration_table != nullptr) {
    tables_ = DepthTables(registration);
  }
  functions.destroy_registration(&registration);
}

void KinectConnection::run() {
  pthread_setname_np(pthread_self(), "kinect");
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    const bool streaming = depth_.sink != nullptr || video_.sink != nullptr;
    if (!streaming) changed_.wait(lock, [this] { return ending_ || !tasks_.empty(); });
    while (!tasks_.empty()) {
      std::packaged_task<int()> task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
      lock.lock();
    }
    if (ending_) break;
    lock.unlock();
    if (depth_.sink != nullptr || video_.sink != nullptr) processEvents();
    lock.lock();
  }
  lock.unlock();
  if (depth_.sink != nullptr) stop(depth_);
  if (video_.sink != nullptr) stop(video_);
  if (device_ != nullptr) freenect_close_device(device_);
  if (context_ != nullptr) freenect_shutdown(context_);
}

void KinectConnection::processEvents() {
  timeval wait{0, kWait};
  const int status = freenect_process_events_timeout(context_, &wait);
  if (status < 0 && status != kInterrupted) lose();
}

void KinectConnection::lose() {
  if (depth_.sink != nullptr) stop(depth_);
  if (video_.sink != nullptr) stop(video_);
  if (!lost_.exchange(true)) on_lost_();
}

bool KinectConnection::startDepth(FrameSink& sink) {
  return call([&] {
           const freenect_frame_mode mode = findDepthMode();
           if (lost_ || mode.is_valid == 0) return kFailure;
           if (freenect_set_depth_mode(device_, mode) < 0) return kFailure;
           const auto bytes = static_cast<std::size_t>(mode.bytes);
           return start(depth_, bytes, sink, freenect_start_depth) ? 0 : kFailure;
         }) == 0;
}

bool KinectConnection::startVideo(freenect_video_format format, freenect_resolution resolution,
                                  FrameSink& sink) {
  return call([&] {
           const freenect_frame_mode mode = findVideoMode(format, resolution);
           if (lost_ || mode.is_valid == 0) return kFailure;
           if (freenect_set_video_mode(device_, mode) < 0) return kFailure;
           const auto bytes = static_cast<std::size_t>(mode.bytes);
           return start(video_, bytes, sink, freenect_start_video) ? 0 : kFailure;
         }) == 0;
}

bool KinectConnection::start(Channel& channel, std::size_t bytes, FrameSink& sink,
                             int (*begin)(freenect_device*)) {
  channel.sink = &sink;
  channel.bytes = bytes;
  channel.buffer = sink.buffer();
  channel.set_buffer(device_, channel.buffer);
  if (begin(device_) >= 0) return true;
  channel.sink = nullptr;
  return false;
}

void KinectConnection::stopDepth() {
  call([this] {
    if (depth_.sink != nullptr) stop(depth_);
    return 0;
  });
}

void KinectConnection::stopVideo() {
  call([this] {
    if (video_.sink != nullptr) stop(video_);
    return 0;
  });
}

void KinectConnection::stop(Channel& channel) {
  channel.stop(device_);
  channel.sink = nullptr;
}

void KinectConnection::deliver(Channel& channel, const void* data, std::uint32_t ticks) {
  if (channel.sink == nullptr) return;
  if (data != channel.buffer) std::memcpy(channel.buffer, data, channel.bytes);
  channel.sink->finished(clock_.at(ticks));
  channel.buffer = channel.sink->buffer();
  channel.set_buffer(device_, channel.buffer);
}

std::optional<openni2_plugin::Acceleration> KinectConnection::acceleration() {
  double left = 0.0, up = 0.0, forward = 0.0;
  const int status = call([&] {
    if (lost_ || !motor_ || freenect_update_tilt_state(device_) < 0) return kFailure;
    freenect_raw_tilt_state* const state = freenect_get_tilt_state(device_);
    if (state == nullptr) return kFailure;
    // The Kinect's own axes: x to its left, y up, z where it looks (Kinect for Windows SDK,
    // AccelerometerGetCurrentReading); level, libfreenect reads +1 g in y.
    freenect_get_mks_accel(state, &left, &up, &forward);
    return 0;
  });
  if (status != 0) return std::nullopt;
  return openni2_plugin::Acceleration{-left, -up, forward};
}

std::optional<double> KinectConnection::tiltAngle() {
  double degrees = 0.0;
  const int status = call([&] {
    if (lost_ || !motor_ || freenect_update_tilt_state(device_) < 0) return kFailure;
    freenect_raw_tilt_state* const state = freenect_get_tilt_state(device_);
    if (state == nullptr || state->tilt_angle == kNoAngle) return kFailure;
    degrees = freenect_get_tilt_degs(state);
    return 0;
  });
  return status == 0 ? std::make_optional(degrees * kDegree) : std::nullopt;
}

bool KinectConnection::tilt(double angle) {
  return call([&] {
           return lost_ || !motor_ ? kFailure : freenect_set_tilt_degs(device_, angle / kDegree);
         }) >= 0;
}

bool KinectConnection::setLed(openni2_plugin::Led led) {
  return call([&] {
           const auto option = static_cast<freenect_led_options>(led);
           return lost_ || !motor_ ? kFailure : freenect_set_led(device_, option);
         }) >= 0;
}

bool KinectConnection::setFlag(freenect_flag flag, bool value) {
  const auto set = optionalFunctions().set_flag;
  if (set == nullptr) return false;
  return call([&] {
           return lost_ ? kFailure : set(device_, flag, value ? FREENECT_ON : FREENECT_OFF);
         }) >= 0;
}

bool KinectConnection::setExposure(int time) {
  const auto set = optionalFunctions().set_exposure;
  if (set == nullptr) return false;
  return call([&] { return lost_ ? kFailure : set(device_, time); }) >= 0;
}

int KinectConnection::call(std::function<int()> function) {
  std::packaged_task<int()> task(std::move(function));
  std::future<int> answer = task.get_future();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  changed_.notify_all();
  return answer.get();
}

}  // namespace dominant_plane_detection::freenect_driver
