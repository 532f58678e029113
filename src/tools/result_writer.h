#pragma once

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "dominant_plane_detection/detection.h"
#include "frame_source.h"

namespace dominant_plane_detection {

/// Writes planes.csv, masks/, overlays/ and, if asked, labels/ and planes_more.csv of a run, and
/// keeps count for its summary.
class ResultWriter {
 public:
  /// @param folder made where it is missing; files of an earlier run are overwritten.
  /// @param labels whether labels/ is written.
  /// @param further_planes whether planes_more.csv is written.
  /// @throw std::runtime_error where it cannot be written.
  ResultWriter(const std::string& folder, bool labels, bool further_planes);

  /// @param ms [ms] time of the detector alone.
  void write(const Frame& frame, const Detection& detection, double ms);

  /// @return a line with how many images, of which state, and the median time, and one for each
  /// state without a plane with the reason that came first.
  std::string summary() const;

 private:
  void writePlane(const Frame& frame, const Detection& detection, double ms);
  void writeFurtherPlanes(const Frame& frame, const Detection& detection);

  struct Outcome {
    std::size_t images = 0;
    std::string first_reason;
  };

  std::string folder_;
  bool labels_;  ///< whether labels/ is written
  std::ofstream planes_;
  std::ofstream further_planes_;             ///< open if it is written
  std::map<std::string, Outcome> outcomes_;  ///< by the state's name
  std::vector<double> ms_;
};

}  // namespace dominant_plane_detection
