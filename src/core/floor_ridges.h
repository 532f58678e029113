#pragma once

#include <cstddef>
#include <vector>

#include "core/floor_bumps.h"
#include "core/local_ground.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// What is higher than the floor close before it and close behind it.
///
/// The floor is followed more closely there than by `LocalGround`, whose window has to be wider
/// than what is looked for: seen at a grazing angle, what stands on the floor is short from row to
/// row. A block's ridge is the smaller one of its two differences to the blocks above and below it,
/// one of them next to it and the other one block farther.
///
/// The two differences have errors that hang together, more or less as the sensor's error is smooth
/// or not. So their covariance is measured on the floor of the image itself, in local errors; of a
/// pair of normal errors that both exceed t, the likeliest is t / scale() standard deviations away.
class FloorRidges {
 public:
  /// @param bumps of the level.
  void find(const GroundLevel& level, const FloorBumps& bumps, const NoiseModel& local_error);

  /// @return [m] how much a block of the level is higher; 0 where it is not, or not known.
  float height(std::size_t block) const { return height_[block]; }
  /// @return [-] local errors for each standard deviation.
  float scale() const { return scale_; }

 private:
  std::vector<float> height_;
  float scale_ = 1.0F;
};

}  // namespace dominant_plane_detection
