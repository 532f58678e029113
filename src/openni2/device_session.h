#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "openni2/camera_device.h"

namespace dominant_plane_detection {

enum class SessionState : std::uint8_t {
  kSearching,  ///< there is no camera yet, or none any more
  kIdle,       ///< a camera is open, nobody wants its images
  kStreaming,  ///< images come
  kSilent,     ///< images should come
  kFinished,   ///< a recording has come to its end
};

struct SessionStatus {
  SessionState state = SessionState::kSearching;
  std::string text;          ///< one sentence
  CameraDescription camera;  ///< empty while searching
  int connections = 0;       ///< [#] of times that a camera was opened
  int restarts = 0;          ///< [#] of times that a silent stream was started anew
};

/// Keeps a camera open and its wanted streams running, whatever happens to it: waits for one that
/// is not there yet, finds the same one again (by its serial number) after it was unplugged, starts
/// silent streams anew. All that may take time happens in another thread.
class DeviceSession {
 public:
  struct Callbacks {
    /// In a thread of the camera's, one frame after the other.
    CameraDevice::FrameCallback frame;
    /// In the session's thread, before the first frame: the camera may be another one now.
    std::function<void(const CameraDevice&)> opened;
    /// In the session's thread, while it is wanted and the camera has an accelerometer.
    std::function<void(const openni2_plugin::Acceleration&)> acceleration;
  };

  /// @param device_id see `chooseCamera`.
  /// @param patience [s] without a frame until a stream is started anew.
  DeviceSession(std::string device_id, const CameraSettings& settings, double patience,
                Callbacks callbacks);
  /// Waits for running callbacks.
  ~DeviceSession();
  DeviceSession(const DeviceSession&) = delete;
  DeviceSession& operator=(const DeviceSession&) = delete;

  /// Somebody wants a stream, or nobody any more. Returns at once.
  void want(StreamKind kind, bool wanted);
  /// The same for readings of the accelerometer, thirty a second where the camera is so fast.
  void wantAcceleration(bool wanted);
  /// Waits until the camera has followed, or refused.
  /// @return why the settings were refused and the old ones stay; empty when they hold. Without a
  /// camera they hold until one comes.
  std::string apply(const CameraSettings& settings);
  void setPatience(double seconds);

  SessionStatus status() const;

 private:
  using Steady = std::chrono::steady_clock;
  struct Change {
    CameraSettings settings;
    std::promise<std::string> answer;
  };

  void run();
  void step();
  bool timeToSearch() const;
  void search();
  void connect(const std::string& uri);
  void disconnect(const std::string& why);
  void makeChange(Change& change);
  std::string changeTo(const CameraSettings& settings);
  void startAndStop();
  void startWanted(StreamKind kind);
  void watch();
  bool anyHeard(double patience) const;
  void readAcceleration();
  double pause() const;
  void onDeviceEvent(const std::string& gone);
  void report(SessionState state, const std::string& text);
  bool wanted(StreamKind kind) const;

  std::string device_id_;
  Callbacks callbacks_;
  std::shared_ptr<OpenNi2Runtime> runtime_;
  int listener_ = 0;

  // Of the session's thread alone.
  CameraSettings wish_;      ///< what was asked for
  CameraSettings settings_;  ///< what this camera can do of it
  std::unique_ptr<CameraDevice> camera_;
  std::string serial_;  ///< of the camera that was found first
  std::string said_;    ///< last sentence of the log about searching
  std::array<std::string, kStreamKinds> said_of_stream_;
  std::array<int, kStreamKinds> restarts_in_a_row_{};
  Steady::time_point opened_;
  double back_off_;       ///< [s] until the next look for a camera
  double penalty_ = 0.0;  ///< [s] without a look, for a camera that went as soon as it came

  std::mutex applying_;       ///< held by whoever waits for an answer
  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  bool ending_ = false;
  bool poked_ = false;  ///< there is something to do
  std::string open_uri_;
  bool gone_ = false;
  Steady::time_point next_search_;
  Steady::time_point earliest_search_;
  std::array<bool, kStreamKinds> wanted_{};
  bool acceleration_wanted_ = false;
  double patience_;
  std::optional<Change> change_;
  SessionStatus status_;

  std::future<void> running_;
};

}  // namespace dominant_plane_detection
