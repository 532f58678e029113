#include "virtual_kinect/virtual_stream.h"

#include <pthread.h>

namespace dominant_plane_detection::virtual_kinect {
namespace {

template <typename Clock>
std::int64_t nanoseconds() {
  return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
}

}  // namespace

VirtualStream::VirtualStream(VirtualDevice& device, OniSensorType sensor)
    : PluginStream(sensor, device.modes(sensor)), device_(device) {}

VirtualStream::~VirtualStream() { stop(); }

OniStatus VirtualStream::start() {
  if (thread_.joinable()) return ONI_STATUS_OK;
  if (device_.gone()) return ONI_STATUS_NO_DEVICE;
  if (!device_.starts(sensor())) {
    device_.explain("the stream does not start, as it was told to");
    return ONI_STATUS_ERROR;
  }
  if (!device_.beginStreaming(sensor())) return ONI_STATUS_OUT_OF_FLOW;
  forgetExposure();  // as cameras may that are started
  stopping_ = false;
  thread_ = std::thread([this] { run(); });
  return ONI_STATUS_OK;
}

void VirtualStream::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  stopping_changed_.notify_all();
  thread_.join();
  device_.endStreaming(sensor());
}

void VirtualStream::run() {
  pthread_setname_np(pthread_self(), "virtual_kinect");
  const auto period =
      std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(1.0 / mode().fps));
  const int stalls = device_.stalls();
  // All streams of a device expose at multiples of their period, so that depth and colour agree.
  auto number = (Steady::now() - device_.begin()) / period + 1;
  for (;;) {
    const Steady::time_point due = device_.begin() + number * period;
    OniFrame* frame = getServices().acquireFrame();
    if (frame == nullptr) return;
    FrameRecord record{};
    record.scene_time = device_.sceneTime(due);
    record.frame_number = static_cast<std::uint32_t>(number);
    record.registered = device_.registered() ? 1 : 0;
    render(record.scene_time, record.frame_number, *frame);
    const bool running = sleepUntil(due);
    if (running && stalls == device_.stalls() && !device_.gone()) {
      describe(static_cast<int>(number), static_cast<std::uint64_t>(device_.clock().at(due)),
               *frame);
      frame->dataSize = static_cast<int>(device_.sent() * frame->dataSize);
      record.timestamp = frame->timestamp;
      record.address = reinterpret_cast<std::uint64_t>(frame->data);
      record.raised = nanoseconds<Steady>();
      // Late frames were exposed when they were due all the same.
      record.exposed = nanoseconds<std::chrono::system_clock>() -
                       std::chrono::nanoseconds(Steady::now() - due).count();
      if (sensor() == ONI_SENSOR_DEPTH) device_.record(record);
      raiseNewFrame(frame);
    }
    getServices().releaseFrame(frame);
    if (!running) return;
    number = std::max(number + 1, (Steady::now() - device_.begin()) / period);
  }
}

bool VirtualStream::sleepUntil(Steady::time_point time) {
  std::unique_lock<std::mutex> lock(mutex_);
  return !stopping_changed_.wait_until(lock, time, [this] { return stopping_; });
}

void VirtualStream::render(double scene_time, std::uint32_t frame, OniFrame& to) const {
  const SceneCamera& camera = device_.camera();
  const int width = mode().resolutionX;
  const int height = mode().resolutionY;
  auto* readings = static_cast<std::uint16_t*>(to.data);
  if (sensor() == ONI_SENSOR_COLOR) {
    camera.colour(scene_time, width, height, brightness(), static_cast<std::uint8_t*>(to.data));
  } else if (sensor() == ONI_SENSOR_IR) {
    camera.infrared(scene_time, width, height, readings);
  } else if (mode().pixelFormat == ONI_PIXEL_FORMAT_SHIFT_9_2) {
    camera.disparity(scene_time, width, height, frame, readings);
  } else {
    camera.depth(scene_time, device_.registered(), width, height, frame, readings);
  }
}

/// @return [-] of an image in relation to one with automatic exposure.
double VirtualStream::brightness() const {
  if (autoExposure()) return 1.0;
  const double by_time =
      exposure() > 0 ? static_cast<double>(exposure()) / kAutomaticExposure : 1.0;
  return by_time * gain() / openni2_plugin::kUnitGain;
}

double VirtualStream::focalLength(bool vertical) const {
  const CameraModel camera = device_.camera().camera(mode().resolutionX, mode().resolutionY);
  return vertical ? camera.fy : camera.fx;
}

}  // namespace dominant_plane_detection::virtual_kinect
