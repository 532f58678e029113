#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// What decides a pixel's label.
struct SegmentationLimits {
  float range_min;        ///< [m] readings outside [range_min, range_max] are unknown
  float range_max;        ///< [m]
  NoiseModel noise;       ///< sigma(z)
  DepthThreshold band;    ///< [m] |height| up to which a pixel is ground, of its depth
  std::size_t min_patch;  ///< [px] smallest connected piece of ground
};

/// What the labelling counted.
struct SegmentationCounts {
  std::size_t ground = 0;  ///< [px]
  double mean_square_error =
      0.0;  ///< [m^2] Eq. 8 over the pixels within the ground band; 0 if none
};

/// Labels every pixel by its height over a plane. Ground is wherever the plane is seen again,
/// however many obstacles lie between.
class GroundSegmentation {
 public:
  /// @param normal [-] unit normal from the plane to the camera.
  /// @param distance [m] camera's height over the plane.
  /// @param labels one `Label` a pixel, row-major; resized to the image.
  SegmentationCounts label(const DepthView& depth, const RayTable& rays,
                           const Eigen::Vector3d& normal, double distance,
                           const SegmentationLimits& limits, std::vector<std::uint8_t>& labels);

 private:
  std::size_t countTiles(int width, int height, const std::vector<std::uint8_t>& labels);
  std::size_t removeSpecks(int width, int height, std::size_t min_patch,
                           std::vector<std::uint8_t>& labels);
  std::size_t collectPiece(std::size_t tile);

  int columns_ = 0;                    ///< [#] tiles
  int rows_ = 0;                       ///< [#] tiles
  std::vector<std::uint8_t> in_tile_;  ///< [px] ground in each tile; 0 once it was visited
  std::vector<std::size_t> piece_;     ///< tiles of the piece at hand
};

}  // namespace dominant_plane_detection
