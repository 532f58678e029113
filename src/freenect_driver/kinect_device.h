#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "freenect_driver/kinect_connection.h"
#include "openni2_plugin/driver_api.h"

namespace dominant_plane_detection::freenect_driver {

/// An opened Kinect v1 as OpenNI2 sees it: depth in mm and as raw disparity, colour, infrared.
class KinectDevice : public oni::driver::DeviceBase {
 public:
  /// What the device leaves to its driver.
  struct Driver {
    std::function<void()> lost;                            ///< must not wait for anything
    std::function<void(const std::string& text)> explain;  ///< why a call fails
  };

  /// @throw std::runtime_error when it cannot be opened.
  KinectDevice(const KinectId& id, Driver driver);

  OniStatus getSensorInfoList(OniSensorInfo** infos, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

  // For its streams.
  KinectConnection& connection() { return connection_; }
  const std::vector<OniVideoMode>& modes(OniSensorType sensor) const;
  bool registered() const { return registered_; }
  /// @return whether the sensor can stream beside those that do.
  bool begin(OniSensorType sensor);
  void end(OniSensorType sensor);
  void explain(const std::string& text) const { driver_.explain(text); }

 private:
  std::string serial_;
  Driver driver_;
  KinectConnection connection_;
  std::vector<OniVideoMode> depth_modes_, colour_modes_, infrared_modes_;
  std::vector<OniSensorInfo> sensors_;
  std::atomic<bool> registered_{false};
  std::mutex mutex_;                                     ///< of `video_`
  OniSensorType video_ = static_cast<OniSensorType>(0);  ///< colour or infrared, while it streams
};

}  // namespace dominant_plane_detection::freenect_driver
