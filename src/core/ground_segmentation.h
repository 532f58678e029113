#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/block_heights.h"
#include "core/drop_off_specks.h"
#include "core/image_kernel.h"
#include "core/low_obstacles.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// What decides a pixel's label.
struct SegmentationLimits {
  NoiseModel noise;       ///< sigma(z)
  DepthThreshold band;    ///< [m] |height| up to which a pixel can be ground, of its depth
  LowObstacleLimits low;  ///< within the band; with a false alarm rate of 0 they are not looked for
};

/// What the labelling counted.
struct SegmentationCounts {
  std::size_t ground = 0;          ///< [px]
  double mean_square_error = 0.0;  ///< [m^2] Eq. 8 over these; 0 if there are none
};

/// Where a plane's surface is, and where surfaces are that are no part of it although they are near
/// the plane. Row-major; as many as cover the image, or more.
struct SurfaceTiles {
  const std::vector<std::uint8_t>& ground;  ///< 1 for its tiles
  const std::vector<std::uint8_t>& other;   ///< kAbove or kBelow for theirs, else 0
};

/// Labels every pixel by its height over a plane. Ground is where the plane's region is: pixels
/// within the band in its tiles and those next to them, which the region may only touch. Elsewhere
/// something else crosses the plane's height, and what it is stays unknown, but on another surface.
class GroundSegmentation {
 public:
  /// @param normal [-] unit normal from the plane to the camera.
  /// @param distance [m] camera's height over the plane.
  /// @param labels one `Label` a pixel, row-major; resized to the image.
  SegmentationCounts label(const ImageInput& input, const Eigen::Vector3d& normal, double distance,
                           const SegmentationLimits& limits, const SurfaceTiles& tiles,
                           std::vector<std::uint8_t>& labels);

 private:
  BlockHeights blocks_;
  LowObstacles low_obstacles_;
  DropOffSpecks specks_;
  std::vector<std::uint8_t> in_row_;      ///< 1 for tiles of the region and their row neighbours
  std::vector<std::uint8_t> tile_kinds_;  ///< `TileKind` of each tile
};

}  // namespace dominant_plane_detection
