#include "core/plane_index.h"

#include <algorithm>
#include <cmath>

#include "core/tile_moments.h"

namespace dominant_plane_detection {
namespace {

/// A plane and the band about it, in single precision.
struct Band {
  Eigen::Vector3f normal;
  float distance, constant, quadratic;
};

/// Numbers the pixels [left, right) of a row.
void numberRow(const ImageInput& input, const Band& band, int v, int left, int right,
               std::uint8_t number, std::uint8_t* index, PlaneShare& share) {
  for (int u = left; u < right; ++u) {
    const float z = metresAt(input.depth, u, v);
    if (!(z >= input.range.min && z <= input.range.max) || index[u] != 0) continue;
    const float height = z * band.normal.dot(input.rays.ray(u, v)) - band.distance;
    // Where the lens cannot be inverted the height is not a number.
    if (!(std::abs(height) <= band.constant + band.quadratic * z * z)) continue;
    index[u] = number;
    ++share.points;
    share.mean_square_error += static_cast<double>(height * height);
  }
}

}  // namespace

PlaneShare numberPixels(const ImageInput& input, const HessePlane& plane,
                        const std::vector<std::uint8_t>& tiles, const DepthThreshold& band,
                        const NoiseModel& noise, std::uint8_t number,
                        std::vector<std::uint8_t>& index) {
  const Band single{plane.normal.cast<float>(), static_cast<float>(plane.distance),
                    static_cast<float>(band.offset + band.sigmas * noise.constant),
                    static_cast<float>(band.sigmas * noise.quadratic)};
  const int width = input.depth.width, columns = covering(width, kTileSize);
  PlaneShare share;
  for (int v = 0; v < input.depth.height; ++v) {
    const std::uint8_t* chosen =
        tiles.data() + static_cast<std::ptrdiff_t>(v / kTileSize) * columns;
    std::uint8_t* row = index.data() + static_cast<std::ptrdiff_t>(v) * width;
    for (int column = 0; column < columns; ++column) {
      if (!chosen[column]) continue;
      const int left = column * kTileSize;
      numberRow(input, single, v, left, std::min(left + kTileSize, width), number, row, share);
    }
  }
  if (share.points > 0) share.mean_square_error /= static_cast<double>(share.points);
  return share;
}

}  // namespace dominant_plane_detection
