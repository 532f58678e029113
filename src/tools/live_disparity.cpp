#include "live_disparity.h"

#include <OpenNI.h>

#include <stdexcept>

#include "openni2/camera_choice.h"
#include "openni2/open_stream.h"
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

LiveDisparity::LiveDisparity(const std::string& device_id) {
  const CameraChoice choice = chooseCamera(device_id, OpenNi2Runtime::instance()->cameras());
  if (choice.uri.empty()) throw std::runtime_error(choice.error);
  camera_ = std::make_unique<OpenStream>(choice.uri);
  openni::VideoStream& stream = camera_->stream;
  if (stream.create(*camera_->device, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
    throw std::runtime_error("there is no depth stream: " + lastOpenNi2Error());
  }
  chooseRawMode(stream);
  if (stream.start() != openni::STATUS_OK) throw std::runtime_error(lastOpenNi2Error());
}

LiveDisparity::~LiveDisparity() = default;

void LiveDisparity::read(int frames, const std::function<void(const DepthView&)>& function) {
  for (int i = 0; i < frames; ++i) {
    openni::VideoFrameRef frame;
    if (!readFrame(camera_->stream, kPatience, frame)) {
      throw std::runtime_error("no images come from the camera");
    }
    function(viewOf(frame));
  }
}

}  // namespace dominant_plane_detection
