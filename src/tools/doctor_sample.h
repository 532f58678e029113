#pragma once

#include <algorithm>
#include <cstddef>

namespace dominant_plane_detection {

/// [#] Images of a recording that are looked at, spread over all, at the most.
constexpr std::size_t kSample = 60;

/// @return [#] one of so many images is looked at.
inline std::size_t sampleStep(std::size_t images) {
  return std::max<std::size_t>(1, (images + kSample - 1) / kSample);
}

}  // namespace dominant_plane_detection
