#include "ros/depth_correction.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace dominant_plane_detection {

void correctDepth(double z_offset, double z_scale, sensor_msgs::Image& depth) {
  if (z_offset == 0.0 && z_scale == 1.0) return;
  const auto scale = static_cast<float>(z_scale);
  const auto offset = static_cast<float>(1000.0 * z_offset);
  constexpr float kMost = std::numeric_limits<std::uint16_t>::max();
  for (std::uint32_t v = 0; v < depth.height; ++v) {
    auto* row = reinterpret_cast<std::uint16_t*>(&depth.data[std::size_t{v} * depth.step]);
    for (std::uint32_t u = 0; u < depth.width; ++u) {
      const float z = std::nearbyint(scale * static_cast<float>(row[u]) + offset);
      row[u] = row[u] != 0 && 0.0F < z && z <= kMost ? static_cast<std::uint16_t>(z) : 0;
    }
  }
}

}  // namespace dominant_plane_detection
