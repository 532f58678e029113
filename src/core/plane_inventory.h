#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/further_planes.h"
#include "core/image_kernel.h"
#include "core/plane_covariance.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// Tells the planes beside the dominant one, and makes ramps ground that are to be.
class PlaneInventory {
 public:
  /// What is known of the image once the dominant plane is.
  struct Image {
    const ImageInput& input;
    const TileMoments& tiles;
    const HessePlane& ground;                 ///< the dominant plane
    const std::vector<std::uint8_t>& region;  ///< 1 for its tiles, padded like the moments
    std::size_t min_points;                   ///< [px] of a further plane
    GroundTiles::Limits pieces;
  };

  /// Does nothing where neither further planes nor ramps are asked for.
  /// @param detection with the dominant plane's labels, and no further planes yet; these and their
  /// index are written, and labels of ramps become ground.
  void tell(const Image& image, const Parameters& parameters, Detection& detection);

 private:
  void collect(const Image& image, const Parameters& parameters, Detection& detection);
  static void rank(std::size_t most, Detection& detection);
  FurtherPlane describe(const Image& image, const Parameters& parameters, const TilePlane& plane);

  FurtherPlanes search_;
  PlaneCovariance covariance_;
  std::vector<std::uint8_t> in_row_, around_;  ///< 1 for a plane's tiles and those about them
};

}  // namespace dominant_plane_detection
