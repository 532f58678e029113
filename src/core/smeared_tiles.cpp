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
    for (int x = 0; x < blocks.columns; ++x) tile[x / kTileBlocks] += from[x];
  }
  for (std::uint8_t& tile : marked_) tile = tile >= kHalf;
  widenTiles(columns_, rows_, marked_, in_row_, wide);
}

void SmearedTiles::spreadFeet(const GroundLevel& level, const LabelRule& rule,
                              std::vector<std::uint8_t>& tiles) {
  feet_.clear();
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
      const float z = level.depth[tile];
      const float narrow = rule.narrow + rule.narrow_z2 * z * z;
      if (std::abs(level.mean[tile]) > kFoot * narrow) take(tile);
    });
  }
}

void SmearedTiles::findClear(const GroundLevel& level, std::vector<float>& clear) const {
  clear.resize(level.size());
  const int side = std::max(level.block / kTileSize, 1);
  for (int y = 0; y < level.rows; ++y) {
    const int top = y * level.block / kTileSize, bottom = std::min(top + side, rows_);
    for (int x = 0; x < level.columns; ++x) {
      const int left = x * level.block / kTileSize, right = std::min(left + side, columns_);
      int smeared = 0;
      for (int j = top; j < bottom; ++j) {
        for (int i = left; i < right; ++i) {
          smeared += unsure_[static_cast<std::size_t>(j * columns_ + i)];
        }
      }
      clear[level.at(x, y)] = 4 * smeared > side * side ? 0.0F : 1.0F;
    }
  }
}

}  // namespace dominant_plane_detection
