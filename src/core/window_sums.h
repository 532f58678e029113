#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dominant_plane_detection {

/// Rows from `first` up to and without `end`.
struct Rows {
  int first, end;
};

/// Sums over the squares of 2 kReach + 1 numbers about each of some rows; what is outside the grid
/// counts 0.
/// @param values row-major, `columns` x `rows`.
/// @param column_sum is overwritten.
/// @param sums as many as `values`, which they are not; other rows keep what they had.
template <int kReach>
void sumWindows(const float* values, int columns, int rows, Rows range,
                std::vector<float>& column_sum, float* sums) {
  const auto width = static_cast<std::size_t>(columns);
  column_sum.assign(width + 2 * kReach, 0.0F);
  const auto row = [&](int y) { return values + static_cast<std::size_t>(y) * width; };
  float* inside = column_sum.data() + kReach;
  const int before = range.first - kReach;
  for (int y = before - kReach; y < range.end; ++y) {
    if (y + kReach < rows && y + kReach >= 0) {
      const float* enters = row(y + kReach);
      for (std::size_t x = 0; x < width; ++x) inside[x] += enters[x];
    }
    if (y - kReach - 1 >= std::max(before, 0)) {
      const float* leaves = row(y - kReach - 1);
      for (std::size_t x = 0; x < width; ++x) inside[x] -= leaves[x];
    }
    if (y < range.first) continue;
    float* out = sums + static_cast<std::size_t>(y) * width;
    const float* from = column_sum.data();
    for (std::size_t x = 0; x < width; ++x) {
      float sum = from[x];
      for (int k = 1; k <= 2 * kReach; ++k) sum += from[x + static_cast<std::size_t>(k)];
      out[x] = sum;
    }
  }
}

}  // namespace dominant_plane_detection
