#include "live_disparity.h"

#include <OpenNI.h>

#include <stdexcept>

#include "openni2/camera_choice.h"
#include "openni2/runtime.h"
#include "openni_frames.h"

namespace dominant_plane_detection {
namespace {

constexpr int kPatience = 3000;  // [ms] for an image

/// @throw std::runtime_error when there is no mode with raw disparity.
void chooseRawMode(openni::VideoStream& stream) {
  const auto& modes = stream.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    if (modes[i].getPixelFormat() != openni::PIXEL_FORMAT_SHIFT_9_2) continue;
    if (stream.setVideoMode(modes[i]) == openni::STATUS_OK) return;
  }
  throw std::runtime_error("the camera streams depth in millimetres only, no raw disparity");
}

}  // namespace

LiveDisparity::LiveDisparity(const std::string& device_id) : runtime_(OpenNi2Runtime::instance()) {
  const CameraChoice choice = chooseCamera(device_id, runtime_->cameras());
  if (choice.uri.empty()) throw std::runtime_error(choice.error);
  device_ = runtime_->open(choice.uri);
  stream_ = std::make_unique<openni::VideoStream>();
  if (stream_->create(*device_, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
    throw std::runtime_error("there is no depth stream: " + lastOpenNi2Error());
  }
  chooseRawMode(*stream_);
  if (stream_->start() != openni::STATUS_OK) throw std::runtime_error(lastOpenNi2Error());
}

LiveDisparity::~LiveDisparity() {
  if (stream_) stream_->destroy();
  if (device_) runtime_->close(std::move(device_));
}

void LiveDisparity::read(int frames, const std::function<void(const DepthView&)>& function) {
  for (int i = 0; i < frames; ++i) {
    openni::VideoFrameRef frame;
    if (!readFrame(*stream_, kPatience, frame)) {
      throw std::runtime_error("no images come from the camera");
    }
    function(viewOf(frame));
  }
}

}  // namespace dominant_plane_detection
