#pragma once

#include <memory>
#include <string>

#include "dominant_plane_detection/camera_model.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {

/// One rendered image with its truth.
struct RecordedFrame {
  std::uint32_t number = 0;  ///< 0, 1, ...
  double time = 0.0;         ///< [s] since the beginning
  Rendering rendering;
  std::vector<std::uint16_t> depth;  ///< [mm]
};

/// Where rendered images go to.
class RecordingWriter {
 public:
  virtual ~RecordingWriter() = default;
  virtual void write(const RecordedFrame& frame) = 0;
};

/// A bag with the topics of a camera whose depth and colour share their pixels, and /truth/plane.
/// @throw std::exception where it cannot be written.
std::unique_ptr<RecordingWriter> openBagWriter(const std::string& file, const CameraModel& camera);

/// depth/ (16-bit, mm), rgb/, mask/ (255 = true ground) and reference.csv.
/// @throw std::exception where it cannot be written.
std::unique_ptr<RecordingWriter> openFolderWriter(const std::string& folder);

}  // namespace dominant_plane_detection
