#pragma once

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "dominant_plane_detection/detection.h"
#include "frame_source.h"

namespace dominant_plane_detection {

/// Writes planes.csv, masks/ and overlays/ of a run, and keeps count for its summary.
class ResultWriter {
 public:
  /// @param folder made where it is missing; files of an earlier run are overwritten.
  /// @throw std::runtime_error where it cannot be written.
  explicit ResultWriter(const std::string& folder);

  /// @param ms [ms] time of the detector alone.
  void write(const Frame& frame, const Detection& detection, double ms);

  /// @return one line: how many images, of which state, and the median time.
  std::string summary() const;

 private:
  std::string folder_;
  std::ofstream planes_;
  std::map<std::string, std::size_t> states_;
  std::vector<double> ms_;
};

}  // namespace dominant_plane_detection
