#pragma once

#include <vector>

#include "freenect_driver/kinect_device.h"
#include "openni2_plugin/plugin_stream.h"

namespace dominant_plane_detection::freenect_driver {

/// One camera of a Kinect. libfreenect writes depth and colour straight into OpenNI2's buffers.
class KinectStream : public openni2_plugin::PluginStream, private FrameSink {
 public:
  KinectStream(KinectDevice& device, OniSensorType sensor);
  ~KinectStream() override;

  OniStatus start() override;
  void stop() override;

 private:
  bool running() const override { return running_; }
  double focalLength(bool vertical) const override;
  bool hasExposure() const override;
  bool onSetting(int id) override;
  void* buffer() override;
  void finished(std::uint64_t time) override;

  bool startCamera();
  void releaseFrame();
  /// @return whether the device has taken an exposure, where one is to be set.
  bool setSettings();
  void convert(std::uint16_t* readings);

  KinectDevice& device_;
  bool running_ = false;
  OniFrame* frame_ = nullptr;        ///< being written
  DepthTables tables_;               ///< of the device
  std::vector<std::uint8_t> spare_;  ///< for what does not go into a frame as it comes
  int number_ = 0;                   ///< of the next frame
};

}  // namespace dominant_plane_detection::freenect_driver
