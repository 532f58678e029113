#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace dominant_plane_detection {

/// Writes `folder`/`name`.png.
/// @throw std::runtime_error that names the file where it cannot be written.
void writePng(const std::string& folder, const std::string& name, const cv::Mat& image);

/// Makes a folder, and those that it is in.
/// @throw std::runtime_error that names the folder where it cannot be made.
void makeFolder(const std::string& folder);

}  // namespace dominant_plane_detection
