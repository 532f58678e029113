#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/block_heights.h"
#include "core/floor_bumps.h"
#include "core/floor_ridges.h"
#include "core/local_ground.h"
#include "core/smeared_tiles.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// What is an obstacle although it is no higher than the worst error of the sensor.
struct LowObstacleLimits {
  double min_height = 0.0;        ///< [m] over the ground about it
  double min_width = 0.0;         ///< [m] the larger side of its outline in the image
  double false_alarm_rate = 0.0;  ///< [1/image] of blocks that the local error lifts over the limit
  NoiseModel local_error;         ///< [m] rms of a block's height over the ground about it
};

/// A block that is higher than the sensor's error explains.
struct Evidence {
  int x, y;      ///< of the block
  float height;  ///< [m] over the ground about it
};

/// Finds blocks that are too high for the sensor's error, where the floor close to them tells how
/// high they should be.
///
/// Three blocks in a row are evidence where their mean is higher than the ground about them by more
/// than the sensor's error explains, or, of the smallest blocks, than the floor close before and
/// close behind them. How much that is follows from the errors on the image's own floor, the number
/// of blocks and the rate of false alarms: were the errors of all blocks independent and normally
/// distributed, that many blocks an image would exceed it; each counts once, although the smallest
/// are asked three ways. Where depth is smeared there is no evidence.
class ObstacleEvidence {
 public:
  /// Finds the ground about all blocks.
  /// @param rule the plane with the ground band.
  /// @param blocks heights over it.
  /// @param kinds the `TileKind` of each tile; those kNearGround that are smeared become kSmeared.
  void look(const RayTable& rays, const LabelRule& rule, const BlockHeights& blocks,
            const LowObstacleLimits& limits, std::vector<std::uint8_t>& kinds);

  const LocalGround& ground() const { return local_ground_; }
  /// @param level one of `ground()`'s.
  void find(const GroundLevel& level, std::vector<Evidence>& evidence);

  /// @return [-] how many standard deviations a block has to be higher.
  static double deviations(std::size_t blocks, double false_alarm_rate);

 private:
  bool isHigh(const GroundLevel& level, int x, int y, float own) const;
  bool isWide(const GroundLevel& level, int x, std::size_t at, float limit) const;
  bool isEvidence(const GroundLevel& level, int x, int y) const;

  LowObstacleLimits limits_;
  float deviations_ = 0.0F;  ///< [-]
  LocalGround local_ground_;
  SmearedTiles smeared_;
  std::vector<float> clear_;  ///< 1 for a level's blocks where depth is not smeared
  FloorBumps bumps_;          ///< of the same level
  FloorRidges ridges_;
};

}  // namespace dominant_plane_detection
