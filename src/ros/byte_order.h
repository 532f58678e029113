#pragma once

#include <cstdint>

namespace dominant_plane_detection {

inline bool machineIsBigEndian() {
  const std::uint16_t one = 1;
  return *reinterpret_cast<const std::uint8_t*>(&one) == 0;
}

}  // namespace dominant_plane_detection
