#include "ros/depth_correction.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace dominant_plane_detection {
namespace {

std::uint16_t* rowOf(sensor_msgs::Image& image, std::uint32_t v) {
  return reinterpret_cast<std::uint16_t*>(&image.data[std::size_t{v} * image.step]);
}

}  // namespace

void correctDepth(double z_offset, double z_scale, sensor_msgs::Image& depth) {
  if (z_offset == 0.0 && z_scale == 1.0) return;
  const auto scale = static_cast<float>(z_scale);
  const auto offset = static_cast<float>(1000.0 * z_offset);
  constexpr float kMost = std::numeric_limits<std::uint16_t>::max();
  for (std::uint32_t v = 0; v < depth.height; ++v) {
    std::uint16_t* const row = rowOf(depth, v);
    for (std::uint32_t u = 0; u < depth.width; ++u) {
      const float z = std::nearbyint(scale * static_cast<float>(row[u]) + offset);
      row[u] = row[u] != 0 && 0.0F < z && z <= kMost ? static_cast<std::uint16_t>(z) : 0;
    }
  }
}

void toMillimetres(const DisparityTable& table, sensor_msgs::Image& depth) {
  for (std::uint32_t v = 0; v < depth.height; ++v) {
    std::uint16_t* const row = rowOf(depth, v);
    table.apply(row, depth.width, row);
  }
}

}  // namespace dominant_plane_detection
