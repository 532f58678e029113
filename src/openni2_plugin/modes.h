#pragma once

#include "openni2_plugin/driver_api.h"

namespace dominant_plane_detection::openni2_plugin {

inline bool sameMode(const OniVideoMode& a, const OniVideoMode& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX &&
         a.resolutionY == b.resolutionY && a.fps == b.fps;
}

/// @return [B] of a pixel of a format that the package's drivers have.
inline int bytesPerPixel(OniPixelFormat format) {
  return format == ONI_PIXEL_FORMAT_RGB888 ? 3 : 2;
}

/// Says in a whole frame of a mode what it is, but for its pixels.
inline void describeFrame(OniSensorType sensor, const OniVideoMode& mode, int index,
                          std::uint64_t timestamp, OniFrame& frame) {
  frame.sensorType = sensor;
  frame.timestamp = timestamp;
  frame.frameIndex = index;
  frame.videoMode = mode;
  frame.width = mode.resolutionX;
  frame.height = mode.resolutionY;
  frame.stride = bytesPerPixel(mode.pixelFormat) * mode.resolutionX;
  frame.dataSize = frame.stride * mode.resolutionY;
  frame.croppingEnabled = FALSE;
  frame.cropOriginX = frame.cropOriginY = 0;
}

}  // namespace dominant_plane_detection::openni2_plugin
