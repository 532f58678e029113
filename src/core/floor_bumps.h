#pragma once

#include <cstddef>
#include <vector>

#include "core/local_ground.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// How much each block and its neighbours to the left and right are higher than the ground about
/// them, and how far the sensor's error alone lets them be. Arrays are row-major, as the level.
struct FloorBumps {
  std::vector<float> over;      ///< [m] mean of the three; 0 where less than two are known
  std::vector<float> is_floor;  ///< 1 where all three are floor, else 0
  /// [-] The rms of `over` on the image's own floor, in local errors: what three blocks average out
  /// differs from sensor to sensor. At least kMinErrorScale; 1 where there is too little floor.
  float scale = 1.0F;

  /// @param clear 1 for blocks that count, 0 for those where depth is smeared.
  void find(const GroundLevel& level, const std::vector<float>& clear,
            const NoiseModel& local_error);

 private:
  void average(const GroundLevel& level, const std::vector<float>& clear);

  std::vector<float> weight_, weighted_;  ///< of a row
};

/// [-] No sensor is trusted to err less than this, in local errors.
constexpr float kMinErrorScale = 0.3F;
/// [-] What is farther off, in local errors, is no error.
constexpr float kMaxError = 2.5F;
/// [#] With fewer of an image's blocks, nothing is known of its errors.
constexpr float kMinErrorSamples = 100.0F;
constexpr int kErrorStep = 4;  // [blocks] of the smallest ones: neighbours say no more

}  // namespace dominant_plane_detection
