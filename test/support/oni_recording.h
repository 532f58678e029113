#pragma once

#include <OpenNI.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "openni2/runtime.h"

namespace dominant_plane_detection {

constexpr int kFramePatience = 20000;  // [ms]

/// Reads the next depth frame. @return its pixels; empty when none came.
inline std::vector<std::uint16_t> readDepth(openni::VideoStream& stream) {
  openni::VideoStream* streams[] = {&stream};
  openni::VideoFrameRef frame;
  int ready = 0;
  if (openni::OpenNI::waitForAnyStream(streams, 1, &ready, kFramePatience) != openni::STATUS_OK ||
      stream.readFrame(&frame) != openni::STATUS_OK) {
    return {};
  }
  const auto* pixels = static_cast<const std::uint16_t*>(frame.getData());
  return {pixels, pixels + frame.getDataSize() / 2};
}

/// Puts a depth stream into its first mode with a pixel format.
inline void setFormat(openni::VideoStream& stream, openni::PixelFormat format) {
  const auto& modes = stream.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    if (modes[i].getPixelFormat() != format) continue;
    if (stream.setVideoMode(modes[i]) == openni::STATUS_OK) return;
  }
  throw std::runtime_error("no such mode: " + lastOpenNi2Error());
}

/// Records depth frames of a device with OpenNI2's own recorder.
/// @return the pixels of what was read meanwhile.
inline std::vector<std::vector<std::uint16_t>> recordOni(
    const std::string& uri, const std::string& file, int frames,
    openni::PixelFormat format = openni::PIXEL_FORMAT_DEPTH_1_MM) {
  const auto require = [](openni::Status status) {
    if (status != openni::STATUS_OK) throw std::runtime_error(lastOpenNi2Error());
  };
  const auto runtime = OpenNi2Runtime::instance();
  auto device = runtime->open(uri);
  openni::VideoStream stream;
  require(stream.create(*device, openni::SENSOR_DEPTH));
  setFormat(stream, format);
  require(stream.start());
  openni::Recorder recorder;
  require(recorder.create(file.c_str()));
  require(recorder.attach(stream));
  require(recorder.start());
  std::vector<std::vector<std::uint16_t>> pixels;
  for (int i = 0; i < frames; ++i) pixels.push_back(readDepth(stream));
  recorder.stop();
  recorder.destroy();
  stream.destroy();
  runtime->close(std::move(device));
  return pixels;
}

/// Reads all depth frames of a recording with OpenNI2's own player, one after the other. What was
/// read while it was recorded need not be all of it.
inline std::vector<std::vector<std::uint16_t>> readOni(const std::string& file) {
  const auto runtime = OpenNi2Runtime::instance();
  auto device = runtime->open(file);
  openni::VideoStream stream;
  if (stream.create(*device, openni::SENSOR_DEPTH) != openni::STATUS_OK ||
      device->getPlaybackControl()->setSpeed(-1.0F) != openni::STATUS_OK ||
      stream.start() != openni::STATUS_OK) {
    throw std::runtime_error(lastOpenNi2Error());
  }
  std::vector<std::vector<std::uint16_t>> pixels;
  const int frames = device->getPlaybackControl()->getNumberOfFrames(stream);
  for (int i = 0; i < frames; ++i) pixels.push_back(readDepth(stream));
  stream.stop();
  letPlayerRest();
  stream.destroy();
  runtime->close(std::move(device));
  return pixels;
}

}  // namespace dominant_plane_detection
