#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/block_heights.h"
#include "core/label_rule.h"
#include "core/ray_table.h"
#include "core/window_sums.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// The ground's height near each block of one size. Arrays are row-major.
struct GroundLevel {
  int block = 0;  ///< [px] side of the blocks
  int columns = 0, rows = 0;
  float min_depth = 0.0F;          ///< [m] nearer, the window is too small for what is looked for
  int first_row = 0, end_row = 0;  ///< rows with such blocks; what is far from them is not kept
  std::vector<float> count;        ///< [#] readings
  std::vector<float> mean;         ///< [m] height of the readings; 0 where there are too few
  std::vector<float> ground;       ///< [m] height of the ground about the block
  std::vector<float> support;      ///< [-] share of the window that this comes from
  std::vector<float> depth;        ///< [m] of the plane; 0 above its horizon
  std::vector<float> can_support;  ///< 1 for blocks that are enough ground to have a say, else 0

  std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * columns + x); }
  /// @return whether half of the block's pixels have a reading.
  bool isRead(std::size_t at) const {
    return 2.0F * count[at] >= static_cast<float>(block * block);
  }
  /// @return [m] the ground's height at a pixel, linear between the blocks.
  float groundAt(int u, int v) const;
};

/// [blocks] How far a window of the ground about a block reaches to either side.
constexpr int kGroundReach = 3;

/// Rows that are searched, and those about them whose ground is kept.
Rows keptRows(const GroundLevel& level);

/// The smooth surface of the ground: where a sensor sees a plane, bent by its error.
///
/// Most of the error of a depth camera is smooth over the image, so the ground near a block tells
/// what the sensor reads for height 0 there. From blocks of 16 pixels to blocks of 4, the ground's
/// height is the mean of the 7 x 7 blocks about each, those left out whose height is farther than
/// 2.5 local errors from what the level before has found: what stands on the ground is not part of
/// it. A small window follows the error closely and is blind for what fills it, a large one the
/// other way round; all levels are kept.
class LocalGround {
 public:
  /// @param kinds the `TileKind` of each tile, row-major: those that are not kNearGround have no
  /// say.
  /// @param local_error [m] rms of a block's height over the ground about it.
  /// @param min_window [m] narrowest window that is of use.
  void fit(const BlockHeights& blocks, const std::vector<std::uint8_t>& kinds, const RayTable& rays,
           const LabelRule& plane, const NoiseModel& local_error, double min_window);

  /// @return from blocks of 4 pixels to blocks of 16.
  const std::array<GroundLevel, 3>& levels() const { return levels_; }
  /// @return the level whose blocks are the tiles.
  const GroundLevel& tiles() const { return levels_[1]; }

 private:
  void collect(const BlockHeights& blocks);
  void average(const std::vector<std::uint8_t>& kinds, GroundLevel& level);
  void start(const GroundLevel* coarser, GroundLevel& level);
  void smooth(GroundLevel& level, const NoiseModel& local_error, float clip);

  std::array<GroundLevel, 3> levels_;
  std::vector<float> weight_, weighted_, window_weight_, window_sum_, column_sum_;
};

}  // namespace dominant_plane_detection
