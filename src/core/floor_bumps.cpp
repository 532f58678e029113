#include "core/floor_bumps.h"

#include <algorithm>
#include <cmath>

namespace dominant_plane_detection {
namespace {

/// [#] How often a sensor that errs more than its profile says is measured again: what is cut off
/// at 2.5 times the profile's errors says too little about its own.
constexpr int kWider = 4;

/// The rms of what is not farther off than a scale allows; 1 where there is too little floor.
float errorScale(const GroundLevel& level, const FloorBumps& bumps, const NoiseModel& local_error,
                 float scale) {
  const std::size_t step = level.block == kBlockSize ? kErrorStep : 1;
  const std::size_t end = level.at(0, level.end_row);
  float count = 0.0F, squares = 0.0F;
  for (std::size_t at = level.at(0, level.first_row); at < end; at += step) {
    if (bumps.is_floor[at] == 0.0F || !(level.depth[at] >= level.min_depth)) continue;
    const float error = bumps.over[at] /
                        static_cast<float>(local_error.sigma(static_cast<double>(level.depth[at])));
    if (!(std::abs(error) < kMaxError * scale)) continue;
    count += 1.0F;
    squares += error * error;
  }
  if (count < kMinErrorSamples) return 1.0F;
  return std::max(std::sqrt(squares / count), kMinErrorScale);
}

}  // namespace

void FloorBumps::average(const GroundLevel& level, const std::vector<float>& clear) {
  const auto columns = static_cast<std::size_t>(level.columns);
  weight_.assign(columns + 2, 0.0F);
  weighted_.assign(columns + 2, 0.0F);
  const Rows rows = keptRows(level);
  for (int y = rows.first; y < rows.end; ++y) {
    const std::size_t first = level.at(0, y);
    const float* mean = level.mean.data() + first;
    const float* ground = level.ground.data() + first;
    const float* floor = level.can_support.data() + first;
    const float* is_clear = clear.data() + first;
    float* const weight = weight_.data() + 1;
    float* const weighted = weighted_.data() + 1;
    for (std::size_t x = 0; x < columns; ++x) {
      weight[x] = level.isRead(first + x) ? is_clear[x] : 0.0F;
      weighted[x] = weight[x] * (mean[x] - ground[x]);
    }
    float* to = over.data() + first;
    float* to_floor = is_floor.data() + first;
    for (std::size_t x = 0; x < columns; ++x) {
      const float known = weight_[x] + weight_[x + 1] + weight_[x + 2];
      const float sum = weighted_[x] + weighted_[x + 1] + weighted_[x + 2];
      to[x] = known >= 2.0F ? sum / std::max(known, 1.0F) : 0.0F;
      to_floor[x] = known == 3.0F ? floor[x] : 0.0F;
    }
    for (std::size_t x = 1; x + 1 < columns; ++x) to_floor[x] *= floor[x - 1] * floor[x + 1];
  }
}

void FloorBumps::find(const GroundLevel& level, const std::vector<float>& clear,
                      const NoiseModel& local_error) {
  over.resize(level.size());
  is_floor.resize(level.size());
  average(level, clear);
  scale = errorScale(level, *this, local_error, 1.0F);
  for (int i = 0; i < kWider && scale > 1.0F; ++i) {
    scale = errorScale(level, *this, local_error, scale);
  }
}

}  // namespace dominant_plane_detection
