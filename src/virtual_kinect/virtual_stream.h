#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "openni2_plugin/plugin_stream.h"
#include "virtual_kinect/virtual_device.h"

namespace dominant_plane_detection::virtual_kinect {

/// One sensor of a virtual Kinect. Frames are rendered straight into OpenNI2's buffers, each ahead
/// of its time, in a thread called "virtual_kinect"; what is not ready in time is left out.
class VirtualStream : public openni2_plugin::PluginStream {
 public:
  VirtualStream(VirtualDevice& device, OniSensorType sensor);
  ~VirtualStream() override;

  OniStatus start() override;
  void stop() override;

 private:
  using Steady = DeviceClock::Steady;

  void run();
  /// @return false when the stream has been stopped meanwhile.
  bool sleepUntil(Steady::time_point time);
  void render(double scene_time, std::uint32_t frame, OniFrame& to) const;
  bool running() const override { return thread_.joinable(); }
  double focalLength(bool vertical) const override;
  bool hasExposure() const override { return true; }
  bool hasGain() const override { return true; }
  double brightness() const;

  VirtualDevice& device_;
  std::mutex mutex_;
  std::condition_variable stopping_changed_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace dominant_plane_detection::virtual_kinect
