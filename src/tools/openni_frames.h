#pragma once

#include <OpenNI.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// Waits for a frame: reading one that never comes would never return.
/// @param patience [ms]
/// @return false when there was none.
inline bool readFrame(openni::VideoStream& stream, int patience, openni::VideoFrameRef& frame) {
  openni::VideoStream* streams[] = {&stream};
  int ready = 0;
  return openni::OpenNI::waitForAnyStream(streams, 1, &ready, patience) == openni::STATUS_OK &&
         stream.readFrame(&frame) == openni::STATUS_OK;
}

/// @return a frame's 16-bit pixels, in the frame's memory.
/// @throw std::runtime_error when there are fewer than the frame says, as in a damaged recording.
inline DepthView viewOf(const openni::VideoFrameRef& frame) {
  const std::int64_t expected = std::int64_t{frame.getStrideInBytes()} * frame.getHeight();
  if (frame.getDataSize() < expected || frame.getStrideInBytes() < 2 * frame.getWidth()) {
    throw std::runtime_error("expected " + std::to_string(expected) + " byte of depth, got " +
                             std::to_string(frame.getDataSize()) +
                             ": the recording is damaged, or the camera sent a part of it only");
  }
  DepthView view;
  view.data = frame.getData();
  view.width = frame.getWidth();
  view.height = frame.getHeight();
  view.step = static_cast<std::size_t>(frame.getStrideInBytes());
  return view;
}

}  // namespace dominant_plane_detection
