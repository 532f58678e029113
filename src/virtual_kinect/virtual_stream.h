#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "virtual_kinect/virtual_device.h"

namespace dominant_plane_detection::virtual_kinect {

/// One sensor of a virtual Kinect. Frames are rendered straight into OpenNI2's buffers, each ahead
/// of its time, in a thread called "virtual_kinect"; what is not ready in time is left out.
class VirtualStream : public oni::driver::StreamBase {
 public:
  VirtualStream(VirtualDevice& device, OniSensorType sensor);
  ~VirtualStream() override;

  OniStatus start() override;
  void stop() override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override;

 private:
  using Steady = DeviceClock::Steady;

  void run();
  /// @return false when the stream has been stopped meanwhile.
  bool sleepUntil(Steady::time_point time);
  void render(double scene_time, std::uint32_t frame, OniFrame& to) const;
  OniStatus setMode(const void* data, int size);
  OniStatus setSwitch(OniBool& value, const void* data, int size) const;
  float fieldOfView(bool vertical) const;

  VirtualDevice& device_;
  OniSensorType sensor_;
  OniVideoMode mode_;
  OniBool auto_exposure_ = TRUE;
  OniBool auto_white_balance_ = TRUE;
  std::mutex mutex_;
  std::condition_variable stopping_changed_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace dominant_plane_detection::virtual_kinect
