#include "core/tile_moments.h"

#include <algorithm>

#include "core/tile_moments_kernel.h"

namespace dominant_plane_detection {

void TileMoments::resize(int image_width, int image_height) {
  columns = covering(image_width, kTileSize);
  rows = covering(image_height, kTileSize);
  const std::size_t padded = (size() + kTileSize - 1) / kTileSize * kTileSize + kTileSize;
  for (auto* values : {&count, &x, &y, &z, &xx, &xy, &xz, &yy, &yz, &zz}) {
    values->resize(padded);
    std::fill(values->begin() + static_cast<std::ptrdiff_t>(size()), values->end(), 0.0F);
  }
}

void computeTileMoments(const DepthView& depth, const RayTable& rays, float range_min,
                        float range_max, TileMoments& tiles) {
  tiles.resize(depth.width, depth.height);
  runTileMomentsKernel({depth, rays, {metresPerUnit(depth), range_min, range_max}}, tiles);
}

}  // namespace dominant_plane_detection
