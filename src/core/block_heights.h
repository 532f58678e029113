#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image_kernel.h"
#include "core/tile_moments.h"

namespace dominant_plane_detection {

/// [px] side of the square blocks: fine enough that a box of 12 cm still fills some at 3 m.
constexpr int kBlockSize = 4;

/// Heights over a plane in each image block, row-major. Blocks at the right and lower border may be
/// partly outside the image. Filled by `runLabelKernel`.
struct BlockHeights {
  int columns = 0;           ///< [#]
  int rows = 0;              ///< [#]
  std::vector<float> sum;    ///< [m] of the heights of the readings, cut at the band of the rule
  std::vector<float> count;  ///< [#] readings
  std::vector<std::uint8_t> beyond;  ///< 1 where half of the pixels are beyond the band
  /// 1 where less than half are within twice the band: something tall, or nothing to be read.
  std::vector<std::uint8_t> off;
  /// Sums over the columns of a row of blocks, before they are summed to blocks.
  std::vector<float> column_height, column_count;

  std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  /// @param width, height [px] of the image.
  void resize(int width, int height) {
    columns = covering(width, kBlockSize);
    rows = covering(height, kBlockSize);
    sum.resize(size());
    count.resize(size());
    beyond.resize(size());
    off.resize(size());
    const auto in_tiles = static_cast<std::size_t>(covering(width, kTileSize) * kTileSize);
    column_height.resize(in_tiles);
    column_count.resize(in_tiles);
  }
};

}  // namespace dominant_plane_detection
