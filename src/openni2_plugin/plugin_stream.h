#pragma once

#include <atomic>
#include <vector>

#include "openni2_plugin/driver_api.h"

namespace dominant_plane_detection::openni2_plugin {

/// [%] what OpenNI2 has for a gain that is not known.
constexpr int kUnitGain = 100;

/// What the streams of this package's plug-ins share: modes and properties.
class PluginStream : public oni::driver::StreamBase {
 public:
  /// @param modes of the sensor; the stream begins in the first.
  PluginStream(OniSensorType sensor, const std::vector<OniVideoMode>& modes);

  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;

 protected:
  /// @return whether it streams; its mode stays meanwhile.
  virtual bool running() const = 0;
  /// @return [px] in the present mode.
  virtual double focalLength(bool vertical) const = 0;
  /// @return whether the device lets exposure or gain of its colour camera be set.
  virtual bool hasExposure() const { return false; }
  virtual bool hasGain() const { return false; }
  /// A setting of the colour camera has changed.
  /// @param id of its property. @return whether the device follows it.
  virtual bool onSetting(int /*id*/) { return true; }

  OniSensorType sensor() const { return sensor_; }
  const OniVideoMode& mode() const { return mode_; }
  bool autoExposure() const { return auto_exposure_ != FALSE; }
  bool autoWhiteBalance() const { return auto_white_balance_ != FALSE; }
  /// @return [us] as set last, 0 if never.
  int exposure() const { return exposure_; }
  /// @return [%] as set last.
  int gain() const { return gain_; }

  /// Exposure and gain are as the device has them by itself.
  void forgetExposure();

  /// Says of a whole frame in the present mode what it is, but for its pixels.
  void describe(int index, std::uint64_t timestamp, OniFrame& frame) const;

 private:
  OniStatus setMode(const void* data, int size);
  /// @return whether the colour camera has a setting.
  bool hasSetting(int id) const;
  OniStatus setSetting(std::atomic<int>& setting, int id, const void* data, int size);
  int stride() const;
  float fieldOfView(bool vertical) const;

  OniSensorType sensor_;
  std::vector<OniVideoMode> modes_;
  OniVideoMode mode_;
  // Read by the thread that streams, too.
  std::atomic<int> auto_exposure_{TRUE};
  std::atomic<int> auto_white_balance_{TRUE};
  std::atomic<int> exposure_{0};
  std::atomic<int> gain_{kUnitGain};
};

}  // namespace dominant_plane_detection::openni2_plugin
