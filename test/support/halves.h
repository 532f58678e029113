#pragma once

#include <vector>

#include "dominant_plane_detection/parameters.h"
#include "support/recordings.h"

namespace dominant_plane_detection {

/// The plane of an image's left half against that of its right half: a measure of accuracy that
/// needs no truth. The floor is the same, the readings share no pixel.
struct HalfDifference {
  bool found = false;   ///< a plane in both halves
  double angle = 0.0;   ///< [rad] between the normals
  double height = 0.0;  ///< [m] between the camera's distances to the two, absolute
  double square = 0.0;  ///< [-] squared Mahalanobis distance, by the two covariances
};

/// Runs the detector on each half alone: the other half's readings are 0.
HalfDifference compareHalves(const ReferenceSet& set, const ReferenceImage& image,
                             const Parameters& parameters);

/// Medians over the images of a set that have a plane in both halves.
struct HalvesSummary {
  std::size_t images = 0;
  std::size_t found = 0;
  double angle = 0.0;   ///< [rad]
  double height = 0.0;  ///< [m]
};

/// @param algorithm all other parameters are the defaults; the working range is the set's.
HalvesSummary compareHalves(const ReferenceSet& set, Algorithm algorithm);

}  // namespace dominant_plane_detection
