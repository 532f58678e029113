#include <opencv2/imgcodecs.hpp>

#include "frame_source.h"

namespace dominant_plane_detection {
namespace {

class PngSource : public FrameSource {
 public:
  PngSource(const std::vector<std::string>& files, const std::vector<std::string>& names,
            const SourceOptions& options)
      : files_(files), names_(names), options_(options) {}

  std::size_t size() const override { return files_.size(); }

  std::optional<Frame> next() override {
    if (next_ == files_.size()) return std::nullopt;
    const std::size_t i = next_++;
    Frame frame;
    frame.name = names_[i];
    frame.pixels = cv::imread(files_[i], cv::IMREAD_UNCHANGED);
    if (frame.pixels.empty()) {
      throw UnreadableFrame(files_[i] + ": expected a PNG image, could not read one");
    }
    if (frame.pixels.type() != CV_16UC1) {
      throw UnreadableFrame(files_[i] + ": expected one channel of 16 bits, got " +
                            cv::typeToString(frame.pixels.type()));
    }
    if (!options_.camera) {
      throw UnreadableFrame(files_[i] +
                            ": a PNG does not say its camera, give --camera FX,FY,CX,CY or "
                            "--camera-info FILE");
    }
    frame.depth.data = frame.pixels.data;
    frame.depth.width = frame.pixels.cols;
    frame.depth.height = frame.pixels.rows;
    frame.depth.step = frame.pixels.step;
    frame.depth.metres_per_unit = static_cast<float>(1.0 / options_.units_per_metre);
    frame.camera = *options_.camera;
    if (frame.camera.width == 0) {
      frame.camera.width = frame.pixels.cols;
      frame.camera.height = frame.pixels.rows;
    }
    return frame;
  }

 private:
  std::vector<std::string> files_;
  std::vector<std::string> names_;
  SourceOptions options_;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> openPngFiles(const std::vector<std::string>& files,
                                          const std::vector<std::string>& names,
                                          const SourceOptions& options) {
  return std::make_unique<PngSource>(files, names, options);
}

}  // namespace dominant_plane_detection
