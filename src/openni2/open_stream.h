#pragma once

#include <OpenNI.h>

#include <memory>
#include <string>

#include "openni2/runtime.h"

namespace dominant_plane_detection {

/// An open device and a stream of it, which its user creates. They end in the order that OpenNI2
/// bears, whatever happened in between.
struct OpenStream {
  /// @throw std::runtime_error with OpenNI2's reason.
  explicit OpenStream(const std::string& uri) : device(runtime->open(uri)) {}
  ~OpenStream() {
    stream.stop();
    if (device->isFile()) letPlayerRest();
    stream.destroy();
    runtime->close(std::move(device));
  }
  OpenStream(const OpenStream&) = delete;
  OpenStream& operator=(const OpenStream&) = delete;

  std::shared_ptr<OpenNi2Runtime> runtime = OpenNi2Runtime::instance();
  std::unique_ptr<openni::Device> device;
  openni::VideoStream stream;
};

}  // namespace dominant_plane_detection
