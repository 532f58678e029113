#include "core/floor_ridges.h"

#include <algorithm>
#include <cmath>

namespace dominant_plane_detection {
namespace {

constexpr int kNext = 1, kFarther = 2;  // [blocks]

/// Sums over pairs of differences, in errors.
struct PairSums {
  float count = 0.0F;
  float next = 0.0F, farther = 0.0F, both = 0.0F;  ///< of squares, and of products
};

/// Of the pairs that both exceed t, the likeliest is that of two times t, which is
/// t sqrt(1' inverse(C) 1) standard deviations away for a covariance C; but where the difference
/// that varies less takes the other one along, that one alone counts.
/// @return [-] t for each standard deviation.
float scaleOf(const PairSums& sums) {
  const float a = sums.next / sums.count, b = sums.farther / sums.count;
  const float c = sums.both / sums.count;
  if (c >= std::min(a, b)) return std::sqrt(std::min(a, b));
  // Never negative but by rounding, where the one is a multiple of the other.
  return std::sqrt(std::max(a * b - c * c, 0.0F) / (a + b - 2.0F * c));
}

/// One row of blocks and those about it; 0 is the row itself.
class BumpRows {
 public:
  BumpRows(const GroundLevel& level, const FloorBumps& bumps, int y) {
    for (int k = -kFarther; k <= kFarther; ++k) {
      over_[k + kFarther] = bumps.over.data() + level.at(0, y + k);
      is_floor_[k + kFarther] = bumps.is_floor.data() + level.at(0, y + k);
    }
  }
  /// @return [m] how much a block is higher than the one `rows` below it.
  float over(int x, int rows) const { return over_[kFarther][x] - over_[kFarther + rows][x]; }
  /// @return 1 where all five are floor, else 0.
  float known(int x) const {
    return is_floor_[0][x] * is_floor_[1][x] * is_floor_[2][x] * is_floor_[3][x] * is_floor_[4][x];
  }

 private:
  const float* over_[2 * kFarther + 1];
  const float* is_floor_[2 * kFarther + 1];
};

void findInRow(const BumpRows& rows, int columns, float* height) {
  for (int x = 0; x < columns; ++x) {
    const float ridge = std::max(std::min(rows.over(x, kNext), rows.over(x, -kFarther)),
                                 std::min(rows.over(x, kFarther), rows.over(x, -kNext)));
    height[x] = rows.known(x) * std::max(ridge, 0.0F);
  }
}

/// The other pair, next behind and farther before, has errors of the same kind.
void addPairs(const GroundLevel& level, int y, const BumpRows& rows, float scale,
              const NoiseModel& local_error, PairSums& sums) {
  const float* depth = level.depth.data() + level.at(0, y);
  for (int x = 0; x < level.columns; x += kErrorStep) {
    if (rows.known(x) == 0.0F || !(depth[x] >= level.min_depth)) continue;
    const auto error = scale * static_cast<float>(local_error.sigma(static_cast<double>(depth[x])));
    const float next = rows.over(x, kNext) / error;
    const float farther = rows.over(x, -kFarther) / error;
    if (!(std::max(std::abs(next), std::abs(farther)) < kMaxError)) continue;
    sums.count += 1.0F;
    sums.next += next * next;
    sums.farther += farther * farther;
    sums.both += next * farther;
  }
}

}  // namespace

void FloorRidges::find(const GroundLevel& level, const FloorBumps& bumps,
                       const NoiseModel& local_error) {
  height_.assign(level.size(), 0.0F);
  PairSums sums;
  // Of a sensor that errs more than its profile says, larger differences are errors.
  const float larger = std::max(bumps.scale, 1.0F);
  const int end = std::min(level.end_row, level.rows - kFarther);
  for (int y = std::max(level.first_row, kFarther); y < end; ++y) {
    const BumpRows rows(level, bumps, y);
    findInRow(rows, level.columns, height_.data() + level.at(0, y));
    addPairs(level, y, rows, larger, local_error, sums);
  }
  scale_ = sums.count < kMinErrorSamples ? 1.0F : std::max(larger * scaleOf(sums), kMinErrorScale);
}

}  // namespace dominant_plane_detection
