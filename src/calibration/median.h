#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dominant_plane_detection {

/// @return the middle one; of an even number the larger of the two.
/// @pre there are values.
template <typename Value>
Value median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace dominant_plane_detection
