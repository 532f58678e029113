#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image_kernel.h"
#include "core/kdtree_region_growing.h"
#include "core/plane_selection.h"
#include "core/seed_selection.h"
#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// Grows regions of points: every n-th one of every n-th row.
class KdtreeSearch {
 public:
  std::size_t run(const ImageInput& input, const Parameters& parameters, PlaneSelection& selection);

 private:
  void collectPoints(const ImageInput& input, int subsampling);
  bool drawSeeds(std::size_t first, std::array<std::size_t, 3>& seeds);

  KdtreeRegionGrowing growing_;
  RandomDraw draw_;
  int columns_ = 0;                       ///< [#] of the subsampled image
  int rows_ = 0;                          ///< [#]
  std::vector<Eigen::Vector3d> points_;   ///< [m]
  std::vector<std::size_t> pixel_of_;     ///< subsampled pixel of each point
  std::vector<std::ptrdiff_t> point_of_;  ///< point of each subsampled pixel, -1: no reading
  std::vector<std::uint8_t> claimed_;     ///< points of earlier regions
};

}  // namespace dominant_plane_detection
