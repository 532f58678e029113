#include <OpenNI.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "frame_source.h"
#include "openni2/open_stream.h"
#include "openni_frames.h"

namespace dominant_plane_detection {
namespace {

constexpr float kMillimetre = 0.001F;  // [m]
constexpr int kEnd = 2000;  // [ms] without a frame: reading on at the end would never return

/// [us] as SEC.NNNNNNNNN
std::string frameName(std::uint64_t microseconds) {
  char name[40];
  std::snprintf(name, sizeof(name), "%llu.%06llu000",
                static_cast<unsigned long long>(microseconds / 1000000U),
                static_cast<unsigned long long>(microseconds % 1000000U));
  return name;
}

/// The depth frames of an .oni file, read as fast as they are asked for.
class OniSource : public FrameSource {
 public:
  OniSource(const std::string& file, const SourceOptions& options)
      : file_(file), camera_(options.camera), recording_(std::filesystem::absolute(file).string()) {
    openni::PlaybackControl* playback = recording_.device->getPlaybackControl();
    if (playback == nullptr) throw std::runtime_error("this is no recording");
    playback->setRepeatEnabled(false);
    playback->setSpeed(-1.0F);  // each frame waits to be read
    if (!recording_.device->hasSensor(openni::SENSOR_DEPTH) ||
        recording_.stream.create(*recording_.device, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
      throw std::runtime_error("there is no depth stream in it");
    }
    frames_ = static_cast<std::size_t>(std::max(playback->getNumberOfFrames(recording_.stream), 0));
    readFormat(options.raw_disparity);
    if (recording_.stream.start() != openni::STATUS_OK) {
      throw std::runtime_error(lastOpenNi2Error());
    }
  }

  std::size_t size() const override { return frames_; }

  std::optional<Frame> next() override {
    if (read_ >= frames_) return std::nullopt;
    if (!readFrame(recording_.stream, kEnd, frame_)) {
      const std::size_t missing = frames_ - read_;
      read_ = frames_;
      throw UnreadableFrame(file_ + ": expected " + std::to_string(frames_) + " images, the last " +
                            std::to_string(missing) + " cannot be read");
    }
    ++read_;
    Frame frame;
    frame.name = frameName(frame_.getTimestamp());
    frame.depth = view();
    frame.camera = camera();
    return frame;
  }

 private:
  void readFormat(bool raw) {
    const auto format = recording_.stream.getVideoMode().getPixelFormat();
    const bool is_raw = format == openni::PIXEL_FORMAT_SHIFT_9_2;
    if (raw ? is_raw : format == openni::PIXEL_FORMAT_DEPTH_1_MM) return;
    if (!raw && format == openni::PIXEL_FORMAT_DEPTH_100_UM) {
      metres_per_unit_ = 0.1F * kMillimetre;
      return;
    }
    const std::string got = is_raw ? "raw disparity" : "pixel format " + std::to_string(format);
    throw std::runtime_error(std::string("expected ") +
                             (raw ? "raw disparity" : "depth in millimetres") + ", got " + got);
  }

  DepthView view() const {
    try {
      DepthView view = viewOf(frame_);
      view.metres_per_unit = metres_per_unit_;
      return view;
    } catch (const std::runtime_error& error) {
      throw UnreadableFrame(file_ + ": " + error.what());
    }
  }

  /// What the user gave, or else a pinhole with the recorded field of view.
  CameraModel camera() const {
    CameraModel model = camera_.value_or(CameraModel());
    if (model.width == 0) {
      model.width = frame_.getWidth();
      model.height = frame_.getHeight();
    }
    if (camera_) return model;
    const double fov = static_cast<double>(recording_.stream.getHorizontalFieldOfView());
    if (!(0.0 < fov && fov < 3.1)) {
      throw UnreadableFrame(file_ +
                            ": it does not tell the camera's field of view, give --camera "
                            "FX,FY,CX,CY or --camera-info FILE");
    }
    model.fx = model.fy = 0.5 * model.width / std::tan(0.5 * fov);
    model.cx = 0.5 * model.width - 0.5;
    model.cy = 0.5 * model.height - 0.5;
    return model;
  }

  std::string file_;
  std::optional<CameraModel> camera_;
  OpenStream recording_;
  openni::VideoFrameRef frame_;  ///< memory of the last frame
  float metres_per_unit_ = kMillimetre;
  std::size_t frames_ = 0;
  std::size_t read_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> openOni(const std::string& file, const SourceOptions& options) {
  return std::make_unique<OniSource>(file, options);
}

}  // namespace dominant_plane_detection
