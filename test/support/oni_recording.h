#pragma once

#include <OpenNI.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "openni2/open_stream.h"

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
  OpenStream camera(uri);
  openni::VideoStream& stream = camera.stream;
  require(stream.create(*camera.device, openni::SENSOR_DEPTH));
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
  return pixels;
}

/// Damages a recording by one bit.
/// @param property in whose record it is, the first one in the file.
/// @param offset [byte] from the first letter of its name.
/// @return the byte as it was.
inline std::uint8_t flipBit(const std::string& file, const std::string& property,
                            std::size_t offset, int bit) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::size_t name = bytes.find(property);
  if (name == std::string::npos) throw std::runtime_error(file + ": no " + property);
  const auto old = static_cast<std::uint8_t>(bytes.at(name + offset));
  stream.seekp(static_cast<std::streamoff>(name + offset));
  stream.put(static_cast<char>(old ^ (1U << bit)));
  return old;
}

/// Reads all depth frames of a recording with OpenNI2's own player, one after the other. What was
/// read while it was recorded need not be all of it.
inline std::vector<std::vector<std::uint16_t>> readOni(const std::string& file) {
  OpenStream recording(file);
  openni::VideoStream& stream = recording.stream;
  openni::PlaybackControl* const playback = recording.device->getPlaybackControl();
  if (stream.create(*recording.device, openni::SENSOR_DEPTH) != openni::STATUS_OK ||
      playback->setSpeed(-1.0F) != openni::STATUS_OK || stream.start() != openni::STATUS_OK) {
    throw std::runtime_error(lastOpenNi2Error());
  }
  std::vector<std::vector<std::uint16_t>> pixels;
  const int frames = playback->getNumberOfFrames(stream);
  for (int i = 0; i < frames; ++i) pixels.push_back(readDepth(stream));
  return pixels;
}

}  // namespace dominant_plane_detection
