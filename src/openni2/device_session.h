#pragma once

#include <array>
#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "openni2/camera_device.h"
#include "openni2/motor_control.h"
#include "openni2/reconnect_policy.h"
#include "openni2/stream_supervisor.h"

namespace dominant_plane_detection {

struct SessionStatus {
  bool open = false;                               ///< there is a camera
  bool accelerometer = false;                      ///< which has one
  bool motor = false;                              ///< which has one, and a light
  std::string problem;                             ///< why there is none
  CameraDescription camera;                        ///< empty without one
  int connections = 0;                             ///< [#] of times that a camera was opened
  std::array<StreamStatus, kStreamKinds> streams;  ///< idle without a camera

  const StreamStatus& stream(StreamKind kind) const {
    return streams[static_cast<std::size_t>(kind)];
  }
};

/// Keeps a camera open and its wanted streams running, whatever happens to it: waits for one that
/// is not there yet, and finds the same one again (by its serial number) after it was unplugged.
/// All that may take time happens in a thread of the session's; its methods may be called from any.
class DeviceSession {
 public:
  struct Callbacks {
    /// In a thread of the stream's, one frame after the other.
    CameraDevice::FrameCallback frame;
    /// In the session's thread, before the first frame: the camera may be another one now.
    std::function<void(const CameraDevice&)> opened;
    /// In the session's thread, while it is wanted and the camera has an accelerometer.
    std::function<void(const openni2_plugin::Acceleration&)> acceleration;
    /// The same of its motor: [rad] that the camera looks up.
    std::function<void(double)> tilt_angle;
  };

  /// @param device_id see `chooseCamera`.
  /// @param patience [s] without a frame until a stream is started anew.
  /// @param reconnect when a camera is looked for that did not come by itself.
  DeviceSession(std::string device_id, const CameraSettings& settings, double patience,
                Callbacks callbacks, const ReconnectPolicy& reconnect = ReconnectPolicy());
  ~DeviceSession();
  DeviceSession(const DeviceSession&) = delete;
  DeviceSession& operator=(const DeviceSession&) = delete;

  /// Closes the camera, waits for running callbacks, and answers who waits in `apply`; for good.
  void end();

  /// Somebody wants a stream, or nobody any more. Returns at once.
  void want(StreamKind kind, bool wanted);
  /// The same for readings of the accelerometer, thirty a second where the camera is so fast.
  void wantAcceleration(bool wanted);
  /// The same for the motor's angle.
  void wantTiltAngle(bool wanted);
  /// The camera's motor and light are to do something, now or when there is a camera. Returns at
  /// once.
  void order(const MotorOrders& orders);
  /// Waits until the camera has followed, or refused.
  /// @return why the settings were refused and the old ones stay; empty when they hold. Without a
  /// camera they hold until one comes.
  std::string apply(const CameraSettings& settings);
  void setPatience(double seconds);
  /// Closes the camera, opens it again, or looks for one where there is none, and waits for that.
  /// Streams that are wanted run on.
  /// @return why there is no camera now; empty when it is open.
  std::string reset();

  SessionStatus status() const;

 private:
  using Clock = ReconnectPolicy::Clock;
  static constexpr const char* kUnloading = "the driver is being unloaded";
  /// What somebody waits for.
  struct Change {
    std::function<std::string()> make;  ///< in the session's thread
    std::promise<std::string> answer;
  };
  /// What is wanted of a camera.
  struct Demand {
    std::array<bool, kStreamKinds> streams{};
    bool acceleration = false;
    bool tilt_angle = false;
    double patience = 0.0;  ///< [s]
  };

  void run();
  void step();
  void search();
  void connect(const std::string& uri);
  void disconnect(const std::string& why);
  void close(const std::string& problem);
  std::string ask(std::function<std::string()> change);
  static void makeChange(Change& change);
  std::string reopen();
  std::string changeTo(const CameraSettings& settings);
  void followOrders();
  void followDemand();
  void want(bool Demand::*reading, bool wanted);
  void read(const Demand& demand);
  bool othersRun(StreamKind kind, double patience) const;
  void onDeviceEvent(const std::string& gone);
  void publishStatus();
  Demand demand() const;
  StreamSupervisor& supervisor(StreamKind kind) {
    return supervisors_[static_cast<std::size_t>(kind)];
  }

  std::string device_id_;
  Callbacks callbacks_;

  // Of the session's thread alone.
  std::shared_ptr<OpenNi2Runtime> runtime_;
  int listener_ = 0;
  CameraSettings requested_;  ///< what was asked for
  CameraSettings settings_;   ///< what this camera can do of it
  std::unique_ptr<CameraDevice> camera_;
  std::array<StreamSupervisor, kStreamKinds> supervisors_{StreamSupervisor(StreamKind::kDepth),
                                                          StreamSupervisor(StreamKind::kColour),
                                                          StreamSupervisor(StreamKind::kInfrared)};
  std::string serial_;        ///< of the camera that was found first
  std::string last_problem_;  ///< of the search, that the log has
  MotorControl motor_;

  std::mutex applying_;       ///< held by whoever waits for an answer
  mutable std::mutex mutex_;  ///< of what follows; never held while anything else is called
  std::condition_variable changed_;
  bool ending_ = false;
  bool demand_changed_ = false;
  std::string open_uri_;
  bool unplugged_ = false;
  ReconnectPolicy reconnect_;
  Demand demand_;
  std::optional<Change> change_;
  MotorOrders orders_;  ///< that wait; the newest of a kind
  SessionStatus status_;

  std::future<void> running_;
};

}  // namespace dominant_plane_detection
