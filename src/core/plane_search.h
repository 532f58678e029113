#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid_region_growing.h"
#include "core/image_kernel.h"
#include "core/kdtree_region_growing.h"
#include "core/plane_selection.h"
#include "core/seed_selection.h"
#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// Seeds are drawn from the lower half of the image (section III.C), where the ground is most
/// likely; from the upper half only when the lower one gave no plane. No further seed is drawn once
/// no region that is left can be larger than the best. Each search returns the number of seeds it
/// tried.

/// @return the thresholds among the parameters.
inline GrowthThresholds growthThresholds(const Parameters& parameters) {
  return {parameters.noise, parameters.delta, parameters.epsilon, parameters.gamma};
}

/// Grows regions of tiles.
class GridSearch {
 public:
  std::size_t run(const TileMoments& tiles, const Parameters& parameters,
                  PlaneSelection& selection);

 private:
  /// Which seeds regions are grown from.
  enum class Seeds {
    kPromising,  ///< those whose tiles are not clearly too tilted to be ground
    kAll,
  };
  std::size_t search(const TileMoments& tiles, const Parameters& parameters, Seeds seeds,
                     PlaneSelection& selection);

  GridRegionGrowing growing_;
  RandomDraw draw_;
};

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
