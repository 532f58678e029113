#pragma once

#include <libfreenect.h>

#include <string>
#include <vector>

namespace dominant_plane_detection::freenect_driver {

constexpr const char* kScheme = "freenect://";

/// A Kinect that is plugged in.
struct KinectId {
  std::string serial;  ///< empty where libfreenect does not tell
  int index = 0;       ///< [#] on the bus; changes when others come and go

  /// @return freenect://SERIAL, or freenect://bus-INDEX without a serial number.
  std::string uri() const;
};

/// @return the mode of the depth camera with raw 11-bit disparity, and one of the colour or
/// infrared camera; invalid where this libfreenect does not have it. Asking libfreenect for a mode
/// that it does not have can end the process.
freenect_frame_mode findDepthMode();
freenect_frame_mode findVideoMode(freenect_video_format format, freenect_resolution resolution);

/// libfreenect, started to see which Kinects there are.
class KinectBus {
 public:
  /// @throw std::runtime_error when libfreenect does not start.
  KinectBus();
  ~KinectBus();
  KinectBus(const KinectBus&) = delete;
  KinectBus& operator=(const KinectBus&) = delete;

  /// @return [#] of Kinects; costs little.
  int count() const;
  /// @return all Kinects. Asks each for its serial number.
  std::vector<KinectId> list() const;

 private:
  freenect_context* context_ = nullptr;
};

}  // namespace dominant_plane_detection::freenect_driver
