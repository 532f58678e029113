#pragma once

#include <libfreenect.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "freenect_driver/depth_tables.h"
#include "freenect_driver/kinect_bus.h"
#include "freenect_driver/tick_clock.h"
#include "openni2_plugin/accelerometer.h"
#include "openni2_plugin/motor.h"

namespace dominant_plane_detection::freenect_driver {

/// Takes the images of a camera; called in the connection's thread.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  /// @return where to write the next image; large enough for it.
  virtual void* buffer() = 0;
  /// The last buffer has been written.
  /// @param time [us] of the device's clock.
  virtual void finished(std::uint64_t time) = 0;
};

/// An open Kinect: a libfreenect of its own, and the one thread that calls it. One Kinect's errors
/// are nobody else's that way, and nothing in libfreenect has to be guarded.
class KinectConnection {
 public:
  /// @param lost called once, in the connection's thread, when the Kinect has gone or its USB
  /// transfers fail. Nothing streams from then on.
  /// @throw std::runtime_error when it cannot be opened.
  KinectConnection(const KinectId& id, std::function<void()> lost);
  ~KinectConnection();
  KinectConnection(const KinectConnection&) = delete;
  KinectConnection& operator=(const KinectConnection&) = delete;

  /// The depth camera's images are raw 11-bit disparity, 16 bits each.
  /// @return false when it does not start.
  bool startDepth(FrameSink& sink);
  /// The colour camera in RGB, or the infrared camera in 10 bits, 640x488.
  bool startVideo(freenect_video_format format, freenect_resolution resolution, FrameSink& sink);
  /// Waits for a sink that is being called.
  void stopDepth();
  void stopVideo();

  /// @return nothing without an accelerometer, or when it does not answer.
  std::optional<openni2_plugin::Acceleration> acceleration();
  bool hasAccelerometer() const { return motor_; }

  // The motor and the light.
  bool hasMotor() const { return motor_; }
  /// @return [rad] that the camera looks up from the horizon; nothing without a motor, when it does
  /// not answer, and while it moves.
  std::optional<double> tiltAngle();
  /// Begins the motion. @return false where the device cannot, as in what follows.
  bool tilt(double angle);
  bool setLed(openni2_plugin::Led led);

  /// @return false where this libfreenect or the device cannot.
  bool setFlag(freenect_flag flag, bool value);
  /// The same for the colour camera's exposure. @param time [us]
  bool setExposure(int time);

  /// What the device knows of its own depth.
  const DepthTables& tables() const { return tables_; }
  bool lost() const { return lost_; }

 private:
  struct Channel {
    FrameSink* sink = nullptr;  ///< while it streams
    void* buffer = nullptr;     ///< of the sink
    std::size_t bytes = 0;      ///< [B] of an image
    int (*set_buffer)(freenect_device*, void*) = nullptr;
    int (*stop)(freenect_device*) = nullptr;
  };

  void open(const KinectId& id);
  void close();
  int openDevice(const KinectId& id, int subdevices);
  void readTables();
  void run();
  void processEvents();
  void lose();
  bool start(Channel& channel, std::size_t bytes, FrameSink& sink, int (*begin)(freenect_device*));
  void stop(Channel& channel);
  void deliver(Channel& channel, const void* data, std::uint32_t ticks);
  /// Runs a function in the connection's thread. @return what it returns.
  int call(std::function<int()> function);

  std::function<void()> on_lost_;
  std::atomic<bool> lost_{false};
  bool motor_ = false;
  DepthTables tables_;

  // Of the connection's thread.
  freenect_context* context_ = nullptr;
  freenect_device* device_ = nullptr;
  Channel depth_, video_;
  TickClock clock_;

  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  std::deque<std::packaged_task<int()>> tasks_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace dominant_plane_detection::freenect_driver
