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

  /// @return the tiles with points of the selected plane's region, each once.
  /// @pre the last `run` found a plane.
  std::vector<std::size_t> regionTiles() const;

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
  int image_width_ = 0;                   ///< [px]
  int subsampling_ = 1;                   ///< [px]
  std::vector<std::size_t> pixel_of_;     ///< subsampled pixel of each point
  std::vector<std::size_t> region_;       ///< points of the selected plane's region
  std::vector<std::ptrdiff_t> point_of_;  ///< point of each subsampled pixel, -1: no reading
  Effort* effort_ = nullptr;
};

}  // namespace dominant_plane_detection
