#pragma once

#include <atomic>
#include <vector>

#include "freenect_driver/kinect_device.h"

namespace dominant_plane_detection::freenect_driver {

/// One camera of a Kinect. libfreenect writes depth and colour straight into OpenNI2's buffers.
class KinectStream : public oni::driver::StreamBase, private FrameSink {
 public:
  KinectStream(KinectDevice& device, OniSensorType sensor);
  ~KinectStream() override;

  OniStatus start() override;
  void stop() override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;

 private:
  void* buffer() override;
  void finished(std::uint64_t time) override;

  bool startCamera();
  void releaseFrame();
  void convert(std::uint16_t* readings);
  OniStatus setMode(const void* data, int size);
  OniStatus setSwitch(freenect_flag flag, OniBool& value, const void* data, int size);
  float fieldOfView(bool vertical) const;

  KinectDevice& device_;
  OniSensorType sensor_;
  OniVideoMode mode_;
  OniBool auto_exposure_ = TRUE;
  OniBool auto_white_balance_ = TRUE;
  bool running_ = false;
  OniFrame* frame_ = nullptr;        ///< being written
  DepthTables tables_;               ///< of the device
  std::vector<std::uint8_t> spare_;  ///< for what does not go into a frame as it comes
  int number_ = 0;                   ///< of the next frame
};

}  // namespace dominant_plane_detection::freenect_driver
