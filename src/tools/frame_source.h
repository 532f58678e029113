#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_correction.h"
#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// A depth image to be looked at.
struct Frame {
  std::string name;      ///< of the files that are written for it
  std::string frame_id;  ///< empty where the source does not tell
  DepthView depth;       ///< of `pixels`, or of memory that the source keeps until the next frame
  cv::Mat pixels;        ///< owns the image where the source does not
  CameraModel camera;
};

/// An image that cannot be read, in one sentence that names it.
class UnreadableFrame : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Depth images one after the other.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// @return [#] of frames, for a progress bar.
  virtual std::size_t size() const = 0;
  /// @return nothing at the end.
  /// @throw UnreadableFrame for one that cannot be read; the next call goes on behind it.
  virtual std::optional<Frame> next() = 0;
};

/// How to read what does not say it itself.
struct SourceOptions {
  std::optional<CameraModel> camera;  ///< its size is that of each image where it is 0
  double units_per_metre = 1000.0;    ///< of 16-bit images
  std::string topic;                  ///< depth topic of bags; empty: the only one
  bool raw_disparity = false;         ///< images are raw disparity, not depth
  std::optional<DepthCorrection> correction;
};

/// 16-bit PNG files.
std::unique_ptr<FrameSource> openPngFiles(const std::vector<std::string>& files,
                                          const std::vector<std::string>& names,
                                          const SourceOptions& options);

/// The depth images of a bag, with the camera_info of each, or else the bag's last one before it.
/// @throw std::runtime_error when the file is no bag, or it is not clear which topic is meant (the
/// message lists them).
std::unique_ptr<FrameSource> openBag(const std::string& file, const SourceOptions& options);

/// The depth images of an OpenNI2 recording, with a pinhole of the recorded field of view.
/// @throw std::runtime_error when the file is no recording, or has no depth.
std::unique_ptr<FrameSource> openOni(const std::string& file, const SourceOptions& options);

}  // namespace dominant_plane_detection
