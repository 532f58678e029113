#pragma once

#include <cstddef>

#include "core/plane_selection.h"
#include "core/seed_order.h"
#include "core/seed_selection.h"

namespace dominant_plane_detection {

/// An algorithm that grows regions from single cells of an image, and claims what it has seen.
class RegionSource {
 public:
  /// @return whether a region may start at the cell: it has a reading, and nothing claimed it.
  virtual bool available(std::size_t cell) const = 0;
  /// @return [px] an upper bound of the size of all regions to come.
  virtual std::size_t availablePoints() const = 0;
  /// Grows a region from an available cell, claims its cells, and lets the selection consider it.
  /// @return whether a region could start there; otherwise the cell does not count as tried.
  virtual bool tryRegion(std::size_t cell) = 0;
  /// @return whether the work for one image is done, even if seeds are left.
  virtual bool exhausted() const { return false; }

 protected:
  ~RegionSource() = default;
};

/// Tries cells as seeds, drawn at random from the lower half of the image and then from the rest,
/// until `seeds` were tried or no region that is left can be better than the best. (One that is a
/// little smaller and nearer may be left: levels compete as parts of one region.)
/// @param draw restarted by the caller; its range is set here.
/// @return [#] seeds tried; 0 when no region could start anywhere.
inline std::size_t searchSeeds(const SeedOrder& order, std::size_t seeds,
                               const PlaneSelection& selection, RandomDraw& draw,
                               RegionSource& source) {
  std::size_t tried = 0;
  const auto search_group = [&](std::size_t begin, std::size_t end) {
    draw.setRange(begin, end);
    while (tried < seeds && !draw.empty() && !source.exhausted() &&
           selection.isOpen(source.availablePoints())) {
      const std::size_t cell = order.cells()[draw.draw()];
      if (source.available(cell) && source.tryRegion(cell)) ++tried;
    }
  };
  search_group(0, order.firstGroup());
  search_group(order.firstGroup(), order.cells().size());
  return tried;
}

}  // namespace dominant_plane_detection
