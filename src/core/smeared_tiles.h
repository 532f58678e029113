#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/block_heights.h"
#include "core/label_rule.h"
#include "core/local_ground.h"

namespace dominant_plane_detection {

/// Where depth is mixed over some pixels: next to what is tall, and to where nothing can be read.
class SmearedTiles {
 public:
  /// @param level whose blocks are the tiles.
  void find(const BlockHeights& blocks, const GroundLevel& level);

  /// The foot of what is beyond the band: tiles next to it, and tiles off the plane that hang
  /// together with these.
  /// @param tiles those of them that are kNearGround become kSmeared.
  void spreadFeet(const GroundLevel& level, const LabelRule& rule,
                  std::vector<std::uint8_t>& tiles);

  /// @param clear becomes 1 for the blocks of the rows that are kept of which at most a quarter is
  /// smeared, else 0.
  void findClear(const GroundLevel& level, std::vector<float>& clear) const;

 private:
  void widen(const BlockHeights& blocks, const std::vector<std::uint8_t>& marked,
             std::vector<std::uint8_t>& wide);

  int columns_ = 0, rows_ = 0;
  std::vector<std::uint8_t> marked_, in_row_;  ///< of `widen`
  std::vector<std::uint8_t> near_beyond_;  ///< 1 for tiles beyond the band, and those about them
  std::vector<std::uint8_t> unsure_;       ///< 1 for tiles that are off, and those about them
  std::vector<std::size_t> feet_;          ///< tiles, in the order they were found
};

}  // namespace dominant_plane_detection
