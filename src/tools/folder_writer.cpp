#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "dominant_plane_detection/detection.h"
#include "png_files.h"
#include "recording_writer.h"

namespace dominant_plane_detection {
namespace {

class FolderWriter : public RecordingWriter {
 public:
  explicit FolderWriter(const std::string& folder) : folder_(folder) {
    for (const char* name : {"/depth", "/rgb", "/mask"}) makeFolder(folder + name);
    reference_.open(folder + "/reference.csv");
    reference_ << "frame,up_x,up_y,up_z,height_m,ground_pixels\n" << std::setprecision(9);
  }

  void write(const RecordedFrame& frame) override {
    const Rendering& rendering = frame.rendering;
    char name[16];
    std::snprintf(name, sizeof(name), "%04u", frame.number);
    // OpenCV takes no const data; nothing writes to it.
    const auto picture = [&](int type, const auto& pixels) {
      using Pixel = std::decay_t<decltype(pixels[0])>;
      return cv::Mat(rendering.height, rendering.width, type, const_cast<Pixel*>(pixels.data()));
    };
    writePng(folder_ + "/depth", name, picture(CV_16UC1, frame.depth));
    cv::Mat bgr;  // what imwrite expects
    const cv::Mat rgb = picture(CV_8UC3, rendering.colour);
    cv::Mat channels[3];
    cv::split(rgb, channels);
    std::swap(channels[0], channels[2]);
    cv::merge(channels, 3, bgr);
    writePng(folder_ + "/rgb", name, bgr);
    const cv::Mat mask = (picture(CV_8UC1, rendering.labels) == static_cast<int>(Label::kGround)) &
                         (picture(CV_16UC1, frame.depth) > 0);
    writePng(folder_ + "/mask", name, mask);
    reference_ << name << ',' << rendering.normal.x() << ',' << rendering.normal.y() << ','
               << rendering.normal.z() << ',' << rendering.distance << ',' << cv::countNonZero(mask)
               << '\n';
    if (!reference_.flush()) {
      throw std::runtime_error(folder_ + "/reference.csv: could not be written");
    }
  }

 private:
  std::string folder_;
  std::ofstream reference_;
};

}  // namespace

std::unique_ptr<RecordingWriter> openFolderWriter(const std::string& folder) {
  return std::make_unique<FolderWriter>(folder);
}

}  // namespace dominant_plane_detection
