#pragma once

#include <vector>

#include "openni2_plugin/driver_api.h"

namespace dominant_plane_detection::openni2_plugin {

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
  /// Automatic exposure or white balance has been turned on or off.
  virtual void onSwitch() {}

  OniSensorType sensor() const { return sensor_; }
  const OniVideoMode& mode() const { return mode_; }
  bool autoExposure() const { return auto_exposure_ != FALSE; }
  bool autoWhiteBalance() const { return auto_white_balance_ != FALSE; }

  /// Says of a whole frame in the present mode what it is, but for its pixels.
  void describe(int index, std::uint64_t timestamp, OniFrame& frame) const;

 private:
  OniStatus setMode(const void* data, int size);
  OniStatus setSwitch(OniBool& value, const void* data, int size);
  int stride() const;
  float fieldOfView(bool vertical) const;

  OniSensorType sensor_;
  std::vector<OniVideoMode> modes_;
  OniVideoMode mode_;
  OniBool auto_exposure_ = TRUE;
  OniBool auto_white_balance_ = TRUE;
};

}  // namespace dominant_plane_detection::openni2_plugin
