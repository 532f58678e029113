#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "openni2/runtime.h"
#include "openni2/sensor_stream.h"
#include "openni2_plugin/accelerometer.h"
#include "openni2_plugin/motor.h"

namespace dominant_plane_detection {

/// What users choose about a camera.
struct CameraSettings {
  VideoMode depth_mode{640, 480, 30};
  VideoMode rgb_mode{640, 480, 30};
  VideoMode ir_mode{640, 480, 30};
  bool depth_registration = false;  ///< depth as seen from the colour camera
  bool raw_disparity = false;       ///< depth as the sensor's raw disparity
  bool auto_exposure = true;        ///< of the colour camera
  bool auto_white_balance = true;   ///< of the colour camera
  /// [us] of the colour camera while `auto_exposure` is off; 0: left as the device has it. Where
  /// the device has a unit of its own, that one.
  int exposure = 0;
  int gain = 0;        ///< [-] the same, in the device's own unit
  bool repeat = true;  ///< a recording begins again at its end

  bool operator==(const CameraSettings& other) const {
    return depth_mode == other.depth_mode && rgb_mode == other.rgb_mode &&
           ir_mode == other.ir_mode && depth_registration == other.depth_registration &&
           raw_disparity == other.raw_disparity && auto_exposure == other.auto_exposure &&
           auto_white_balance == other.auto_white_balance && exposure == other.exposure &&
           gain == other.gain && repeat == other.repeat;
  }
  const VideoMode& mode(StreamKind kind) const {
    if (kind == StreamKind::kDepth) return depth_mode;
    return kind == StreamKind::kColour ? rgb_mode : ir_mode;
  }
  VideoMode& mode(StreamKind kind) {
    return const_cast<VideoMode&>(std::as_const(*this).mode(kind));
  }
};

/// A camera or a recording that is open, with those of the three streams that it has.
class CameraDevice {
 public:
  using FrameCallback = std::function<void(StreamKind, const SensorFrame&)>;

  /// @param callback called in a thread of each stream, one frame after the other.
  /// @throw std::runtime_error with OpenNI2's reason.
  CameraDevice(std::shared_ptr<OpenNi2Runtime> runtime, const std::string& uri,
               const FrameCallback& callback);
  /// Waits for running callbacks.
  ~CameraDevice();
  CameraDevice(const CameraDevice&) = delete;
  CameraDevice& operator=(const CameraDevice&) = delete;

  const CameraDescription& description() const { return description_; }
  bool isRecording() const;
  bool has(StreamKind kind) const { return at(kind) != nullptr; }
  /// @pre has(kind)
  SensorStream& stream(StreamKind kind) { return *at(kind); }
  const SensorStream& stream(StreamKind kind) const { return *at(kind); }

  bool hasAccelerometer() const;
  /// Asks the device.
  /// @return nothing when it does not answer.
  std::optional<openni2_plugin::Acceleration> acceleration() const;

  /// Whether exposure or gain of the colour camera can be set.
  bool hasExposure() const { return canSet(openni::STREAM_PROPERTY_EXPOSURE); }
  bool hasGain() const { return canSet(openni::STREAM_PROPERTY_GAIN); }

  bool hasMotor() const;
  /// Asks the device.
  /// @return [rad] that the camera looks up; nothing when it does not tell, as while it moves.
  std::optional<double> tiltAngle() const;
  /// Begins to turn the camera. @return false when the device does not, as in `setLed`.
  bool tilt(double angle);
  bool setLed(openni2_plugin::Led led);

  /// @return why the camera cannot do what is asked, with what it can; empty when it can.
  std::string refusal(const CameraSettings& settings) const;
  /// @return the settings with what the camera cannot do replaced by what it does by itself.
  CameraSettings possible(CameraSettings settings) const;
  /// Everything but the modes, which `start` sets.
  /// @pre the depth stream has been stopped where `depth_registration` changes.
  /// @param settings that are possible; what the device does not do after all is taken out of them.
  /// @return why it does not; empty when it does all of it.
  std::string apply(CameraSettings& settings);
  /// @throw std::runtime_error with the device's reason.
  void start(StreamKind kind, const CameraSettings& settings);

 private:
  bool hasMode(StreamKind kind, const CameraSettings& settings) const;
  bool canRegister() const;
  /// @return whether the colour camera has a property of OpenNI2's.
  bool canSet(int property) const;
  std::string applyRegistration(CameraSettings& settings);
  std::string applyColour(CameraSettings& settings);
  const std::unique_ptr<SensorStream>& at(StreamKind kind) const {
    return streams_[static_cast<int>(kind)];
  }

  std::shared_ptr<OpenNi2Runtime> runtime_;
  std::unique_ptr<openni::Device> device_;
  CameraDescription description_;
  std::unique_ptr<SensorStream> streams_[kStreamKinds];
};

}  // namespace dominant_plane_detection
