#include "openni2/video_mode.h"

#include <cstdio>

namespace dominant_plane_detection {

std::string toString(const VideoMode& mode) {
  return std::to_string(mode.width) + "x" + std::to_string(mode.height) + "@" +
         std::to_string(mode.rate);
}

std::optional<VideoMode> parseVideoMode(const std::string& text) {
  VideoMode mode;
  int length = 0;
  const int fields =
      std::sscanf(text.c_str(), "%5dx%5d@%4d%n", &mode.width, &mode.height, &mode.rate, &length);
  const bool whole = fields == 3 && static_cast<std::size_t>(length) == text.size();
  if (!whole || mode.width <= 0 || mode.height <= 0 || mode.rate <= 0) return std::nullopt;
  return mode;
}

std::string toString(const std::vector<VideoMode>& modes) {
  std::string text;
  for (const VideoMode& mode : modes) text += (text.empty() ? "" : ", ") + toString(mode);
  return text.empty() ? "none" : text;
}

}  // namespace dominant_plane_detection
