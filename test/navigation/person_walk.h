#pragma once

#include <cstdint>

#include "support/surface_figures.h"

namespace dominant_plane_detection {

/// A person of 1.7 m who walks past, 1.6 to 2.4 m ahead of a robot that stands or drives slowly,
/// and what the map has of the way afterwards.
struct PersonFigures {
  int occupied = 0;  ///< [#] cells of the way that were occupied while the person was in view
  int trace = 0;     ///< [#] of them, those in view, with all about them, 3 s after the person went
  int left = 0;      ///< [#] of these, that have not been free since
};
/// @param speed [m/s] of the robot. @param rate [1/s] of images.
PersonFigures letPersonWalkPast(ErrorKind error, std::uint32_t seed, double speed, double rate);

}  // namespace dominant_plane_detection
