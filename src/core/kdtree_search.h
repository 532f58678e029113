#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image_kernel.h"
#include "core/kdtree_region_growing.h"
#include "core/plane_selection.h"
#include "core/seed_order.h"
#include "core/seed_search.h"
#include "core/seed_selection.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// Grows regions of points: every n-th one of every n-th row.
///
/// No further region is begun once as many tests were made as there are points. A region tests no
/// point twice, so that an image costs at most twice as many tests as it has points.
class KdtreeSearch : private RegionSource {
 public:
  /// @param effort is added to.
  void run(const ImageInput& input, const Parameters& parameters, PlaneSelection& selection,
           Effort& effort);

 private:
  bool available(std::size_t cell) const override;
  std::size_t availablePoints() const override;
  bool tryRegion(std::size_t cell) override;
  bool exhausted() const override;

  void collectPoints(const ImageInput& input, int subsampling);
  bool drawSeeds(std::size_t cell, std::array<std::size_t, 3>& seeds);

  KdtreeRegionGrowing growing_;
  SeedOrder order_;
  RandomDraw draw_;
  GrowthThresholds thresholds_{};
  PlaneSelection* selection_ = nullptr;   ///< of the present run
  std::size_t pixels_per_point_ = 1;      ///< [px]
  int columns_ = 0;                       ///< [#] of the subsampled image
  int rows_ = 0;                          ///< [#]
  std::vector<Eigen::Vector3d> points_;   ///< [m]
  std::vector<std::ptrdiff_t> point_of_;  ///< point of each subsampled pixel, -1: no reading
  Effort* effort_ = nullptr;
};

}  // namespace dominant_plane_detection
