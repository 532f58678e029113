#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dominant_plane_detection {

/// Size and rate of a camera's images, "640x480@30" as text.
struct VideoMode {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  int rate = 0;    ///< [1/s]

  bool operator==(const VideoMode& other) const {
    return width == other.width && height == other.height && rate == other.rate;
  }
};

std::string toString(const VideoMode& mode);

/// @return nothing for a text that is no mode.
std::optional<VideoMode> parseVideoMode(const std::string& text);

/// @return the modes as a list for users.
std::string toString(const std::vector<VideoMode>& modes);

}  // namespace dominant_plane_detection
