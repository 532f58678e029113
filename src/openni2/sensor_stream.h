#pragma once

#include <OniCAPI.h>
#include <OpenNI.h>
#include <sensor_msgs/Image.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "openni2/image_pool.h"
#include "openni2/video_mode.h"

namespace dominant_plane_detection {

/// The images a camera has.
enum class StreamKind : std::uint8_t { kDepth, kColour, kInfrared };
constexpr int kStreamKinds = 3;
constexpr StreamKind kAllStreams[kStreamKinds] = {StreamKind::kDepth, StreamKind::kColour,
                                                  StreamKind::kInfrared};
/// @return "depth", "rgb" or "ir", as topics are called.
const char* toString(StreamKind kind);

struct SensorFrame {
  sensor_msgs::ImagePtr image;    ///< everything but its header
  std::uint64_t device_time = 0;  ///< [us] by the device's clock
  int number = 0;                 ///< counts what the device sent, lost or not
  int rate = 0;                   ///< [1/s] of the stream's mode
  bool registered = false;        ///< depth as seen from the colour camera
  bool raw = false;               ///< depth as raw disparity instead of millimetres
  bool incomplete = false;        ///< the device sent less than an image; the rest has no readings
};

/// One sensor of an open device. Frames are messages whose memory the device's driver has written,
/// and which nobody but the receiver has; where OpenNI2 shares that memory with others, a copy.
class SensorStream {
 public:
  using Callback = std::function<void(const SensorFrame&)>;

  /// @return whether a device has such a sensor.
  static bool isIn(openni::Device& device, StreamKind kind);

  /// @param callback gets the frames, in a thread of the stream's: it may take its time without
  /// holding up other streams, of the same device or of others.
  /// @throw std::runtime_error when the device does not give it.
  SensorStream(openni::Device& device, StreamKind kind, Callback callback);
  /// Waits for a running callback.
  ~SensorStream();
  SensorStream(const SensorStream&) = delete;
  SensorStream& operator=(const SensorStream&) = delete;

  /// @return the modes with 16-bit millimetres, 8-bit RGB or grey; those with raw disparity instead
  /// with `raw`, none but for depth.
  std::vector<VideoMode> modes(bool raw = false) const;
  /// @return the mode it is in; a recording knows no other.
  VideoMode mode() const;
  /// @return [rad] as the device tells, 0 where it does not.
  double horizontalFieldOfView() const;

  /// @return [m] from the depth camera to its projector, as the device tells; 0 where it does not.
  double baseline() const;

  /// @param mode one of `modes()`.
  /// @param registered of the frames to come.
  /// @param raw disparity instead of millimetres.
  /// @throw std::runtime_error with the device's reason.
  void start(const VideoMode& mode, bool registered, bool raw);
  /// Waits for a running callback.
  void stop();
  bool running() const { return running_; }
  /// @return [s] since the last frame, or since `start`.
  double silence() const;
  /// @return whether there was a frame since `start`.
  bool heard() const { return heard_; }

  /// Does nothing where the device cannot.
  void setAutomatic(bool exposure, bool white_balance);
  /// A property of OpenNI2's that is a whole number. @return whether the device has it.
  bool canSet(int property) const { return stream_.isPropertySupported(property); }
  /// @return whether the device has taken the value.
  bool set(int property, int value) {
    return stream_.setProperty(property, value) == openni::STATUS_OK;
  }

 private:
  class Allocator;

  void deliverFrames();
  void deliver();
  void setMode(const VideoMode& mode, bool raw);
  /// @return false when there is no frame after all.
  bool read(openni::VideoFrameRef& frame);
  sensor_msgs::ImagePtr message(const openni::VideoFrameRef& frame);

  StreamKind kind_;
  Callback callback_;
  openni::VideoStream stream_;
  std::unique_ptr<Allocator> allocator_;
  OniCallbackHandle listener_ = nullptr;
  std::mutex delivering_;  ///< reading a frame that stopping has thrown away would never end
  std::atomic<bool> running_{false};
  std::atomic<bool> registered_{false};
  std::atomic<bool> heard_{false};
  std::atomic<std::int64_t> last_sign_{0};  ///< [ns] of the steady clock

  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  bool arrived_ = false;  ///< a frame that is not delivered yet
  bool ending_ = false;
  std::future<void> delivery_;
};

}  // namespace dominant_plane_detection
