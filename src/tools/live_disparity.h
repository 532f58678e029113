#pragma once

#include <functional>
#include <memory>
#include <string>

#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

struct OpenStream;

/// Raw disparity of a connected camera, without ROS.
class LiveDisparity {
 public:
  /// @param device_id see `chooseCamera`.
  /// @throw std::runtime_error when there is no such camera, or it streams no raw disparity.
  explicit LiveDisparity(const std::string& device_id);
  ~LiveDisparity();
  LiveDisparity(const LiveDisparity&) = delete;
  LiveDisparity& operator=(const LiveDisparity&) = delete;

  /// Hands the next images to a function.
  /// @throw std::runtime_error when none come any more.
  void read(int frames, const std::function<void(const DepthView&)>& function);

 private:
  std::unique_ptr<OpenStream> camera_;
};

}  // namespace dominant_plane_detection
