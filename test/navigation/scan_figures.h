#pragma once

#include <cstdint>
#include <vector>

#include "support/surface_figures.h"

namespace dominant_plane_detection {

/// How scans of rooms with things on their floor hold against the truth, which is the exact
/// image's: each of its pixels is a place in the world and belongs to a thing.
///
/// A camera 0.4 to 1 m up looks down by 20 degrees and is rolled by 10; boxes and posts of 0.02 to
/// 0.6 m stand 0.8 to 3.5 m ahead.
struct ScanFigures {
  int images = 0;
  int found = 0;  ///< [#] of them with the floor
  /// Things of 5 to below 10 cm, and of 10 cm and more, that are within 2.5 m and cover 60 pixels;
  /// and how many of them have a reading, within 5 % and 5 cm.
  int low = 0, low_seen = 0, high = 0, high_seen = 0;
  int ghosts = 0;                ///< [#] runs of readings where nothing is, within 5 % and 10 cm
  std::vector<double> off;       ///< [m] of readings that are right, absolute
  std::vector<double> relative;  ///< [-] the same as a share of the range
};

/// Which rule makes the scan.
enum class ScanRule : std::uint8_t {
  kGround,       ///< `GroundScanner`
  kFixedColumns  ///< as depthimage_to_laserscan has it: the nearest of ten rows about the middle
};

/// @param first, count [#] seeds of the scenes.
ScanFigures scanFigures(ErrorKind error, ScanRule rule, std::uint32_t first, int count);

}  // namespace dominant_plane_detection
