#pragma once

#include <sensor_msgs/Image.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "doctor/facts.h"
#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// Fills in what can be said of an image whether or not it can be used.
void describe(const sensor_msgs::Image& image, InputFacts& facts);

/// Looks at depth image messages as the core does: 16UC1 and mono16 in millimetres, 32FC1 in metres
/// (REP 118), of either byte order.
class DepthReader {
 public:
  /// @param image has to outlive the view.
  /// @param error one sentence with what was expected and what came, if there is no view.
  /// @return a view of the message's own memory, or of the reader's where bytes had to be swapped:
  /// that one is valid until the next call.
  std::optional<DepthView> read(const sensor_msgs::Image& image, std::string& error);

 private:
  std::vector<std::uint8_t> swapped_;
};

}  // namespace dominant_plane_detection
