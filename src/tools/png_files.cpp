#include "png_files.h"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace dominant_plane_detection {

void writePng(const std::string& folder, const std::string& name, const cv::Mat& image) {
  const std::string file = folder + "/" + name + ".png";
  if (!cv::imwrite(file, image)) throw std::runtime_error(file + ": could not be written");
}

void makeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error(folder + ": " + error.message());
}

}  // namespace dominant_plane_detection
