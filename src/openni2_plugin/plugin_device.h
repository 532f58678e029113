#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "openni2_plugin/accelerometer.h"
#include "openni2_plugin/driver_api.h"
#include "openni2_plugin/motor.h"

namespace dominant_plane_detection::openni2_plugin {

/// What the devices of this package's plug-ins share: sensors, serial number, registration,
/// accelerometer, motor, and that colour and infrared do not stream together.
class PluginDevice : public oni::driver::DeviceBase {
 public:
  /// @param explain tells OpenNI2 why a call fails.
  PluginDevice(std::string serial, std::function<void(const std::string& text)> explain);

  OniStatus getSensorInfoList(OniSensorInfo** infos, int* count) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

  // For its streams.
  /// @return none where the device has no such sensor.
  std::vector<OniVideoMode> modes(OniSensorType sensor) const;
  /// @return whether depth is to be seen from the colour camera.
  bool registered() const { return registered_; }
  /// @return whether the sensor can stream beside those that do.
  bool beginStreaming(OniSensorType sensor);
  void endStreaming(OniSensorType sensor);
  void explain(const std::string& text) const { explain_(text); }

 protected:
  /// Does nothing without modes.
  void addSensor(OniSensorType sensor, std::vector<OniVideoMode> modes);

  virtual bool canRegister() const = 0;
  virtual bool hasAccelerometer() const = 0;
  /// @return nothing when the device does not answer.
  virtual std::optional<Acceleration> acceleration() = 0;

  /// @return whether it has a motor and a light.
  virtual bool hasMotor() const = 0;
  /// @return [rad] see kTiltAngle; nothing when the device does not answer.
  virtual std::optional<double> tiltAngle() = 0;
  /// @return false when the device does not do it.
  virtual bool tilt(double angle) = 0;
  virtual bool setLed(Led led) = 0;

 private:
  OniStatus setRegistration(const void* data, int size);
  OniStatus setMotor(int id, const void* data, int size);

  std::string serial_;
  std::function<void(const std::string& text)> explain_;
  std::deque<std::vector<OniVideoMode>> modes_;  ///< OpenNI2 keeps pointers into it
  std::vector<OniSensorInfo> sensors_;
  std::atomic<bool> registered_{false};
  std::mutex mutex_;                    ///< of `video_`
  std::optional<OniSensorType> video_;  ///< colour or infrared, while it streams
};

}  // namespace dominant_plane_detection::openni2_plugin
