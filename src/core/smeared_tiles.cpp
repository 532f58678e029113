#include "core/smeared_tiles.h"

#include <algorithm>
#include <cmath>

#include "core/tile_moments.h"
#include "core/tile_neighbours.h"
#include "core/widen_tiles.h"

namespace dominant_plane_detection {
namespace {

/// [-] Of the narrow band: the mean of tiles that are the foot of what they hang together with.
constexpr float kFoot = 2.0F;
constexpr int kTileBlocks = kTileSize / kBlockSize;
constexpr int kHalf = kTileBlocks * kTileBlocks / 2;  // [blocks] of a tile

}  // namespace

void SmearedTiles::find(const BlockHeights& blocks, const GroundLevel& level) {
  columns_ = level.columns;
  rows_ = level.rows;
  widen(blocks, blocks.off, unsure_);
  widen(blocks, blocks.beyond, near_beyond_);
}

/// Widens the tiles of which at least half of the blocks are marked.
void SmearedTiles::widen(const BlockHeights& blocks, const std::vector<std::uint8_t>& marked,
                         std::vector<std::uint8_t>& wide) {
  marked_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
  for (int y = 0; y < blocks.rows; ++y) {
    const std::uint8_t* from = marked.data() + static_cast<std::ptrdiff_t>(y) * blocks.columns;
    std::uint8_t* tile = marked_.data() + static_cast<std::ptrdiff_t>(y / kTileBlocks) * columns_;
    static_assert(kTileBlocks == 2);
    const int whole = blocks.columns / kTileBlocks;
    for (int x = 0; x < whole; ++x) {
      tile[x] = static_cast<std::uint8_t>(tile[x] + from[2 * x] + from[2 * x + 1]);
    }
    if (whole < columns_) tile[whole] = static_cast<std::uint8_t>(tile[whole] + from[2 * whole]);
  }
  for (std::uint8_t& tile : marked_) tile = tile >= kHalf;
  widenTiles(columns_, rows_, marked_, in_row_, wide);
}

void SmearedTiles::spreadFeet(const GroundLevel& level, const LabelRule& rule,
                              std::vector<std::uint8_t>& tiles) {
  feet_.clear();
  feet_.reserve(tiles.size());
  const auto take = [&](std::size_t tile) {
    if (tiles[tile] != kNearGround) return;
    tiles[tile] = kSmeared;
    feet_.push_back(tile);
  };
  for (std::size_t tile = 0; tile < near_beyond_.size(); ++tile) {
    if (near_beyond_[tile]) take(tile);
  }
  for (std::size_t next = 0; next < feet_.size(); ++next) {
    forEachNeighbour(feet_[next], columns_, rows_, [&](std::size_t tile) {
      if (std::abs(level.mean[tile]) > kFoot * rule.narrowBand(level.depth[tile])) take(tile);
    });
  }
}

void SmearedTiles::findClear(const GroundLevel& level, std::vector<float>& clear) const {
  clear.resize(level.size());
  const Rows kept = keptRows(level);
  const bool is_larger = level.block > kTileSize;  // four tiles, and fewer at the border
  const int in_tile = is_larger ? 1 : kTileSize / level.block;
  for (int y = kept.first; y < kept.end; ++y) {
    const int row = is_larger ? 2 * y : y / in_tile;
    const std::uint8_t* tiles = unsure_.data() + static_cast<std::ptrdiff_t>(row) * columns_;
    const std::uint8_t* below = row + 1 < rows_ ? tiles + columns_ : tiles;
    float* to = clear.data() + level.at(0, y);
    for (int x = 0; x < level.columns; ++x) {
      if (is_larger) {
        const int left = 2 * x, right = std::min(left + 1, columns_ - 1);
        to[x] = tiles[left] + tiles[right] + below[left] + below[right] > 1 ? 0.0F : 1.0F;
      } else {
        to[x] = tiles[x / in_tile] ? 0.0F : 1.0F;
      }
    }
  }
}

}  // namespace dominant_plane_detection
