#include "dominant_plane_detection/depth_correction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace dominant_plane_detection {
namespace {

constexpr double kLargest = 0.1;  // [1/m]

/// Where a pixel falls between the middles of cells.
struct Between {
  Between(int pixel, int pixels, int cells) {
    const double place = std::clamp((pixel + 0.5) * cells / pixels - 0.5, 0.0, cells - 1.0);
    first = static_cast<int>(place);
    second = std::min(first + 1, cells - 1);
    share = place - first;
  }
  int first, second;
  double share;
};

template <typename Pixel>
void correctRow(const Pixel* from, float unit, const float* table, int width, float* to) {
  constexpr float kFarthest = 1e6F;  // [m] infinity, too far to be measured, stays what it is
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (int u = 0; u < width; ++u) {
    const float z = unit * static_cast<float>(from[u]);
    const float share = 1.0F - table[u] * z;  // what is as far as 1 / c is infinitely far
    const float corrected = share > 0.0F ? z / share : kInfinity;
    to[u] = z < kFarthest ? corrected : z;
  }
}

}  // namespace

DepthCorrection::DepthCorrection(const Grid& grid) : grid_(grid) {
  const auto cells = static_cast<std::size_t>(std::max(grid.columns, 0)) *
                     static_cast<std::size_t>(std::max(grid.rows, 0));
  if (cells == 0 || grid.inverse_depth.size() != cells) {
    throw std::invalid_argument("expected " + std::to_string(grid.columns) + " x " +
                                std::to_string(grid.rows) + " numbers, at least one, got " +
                                std::to_string(grid.inverse_depth.size()));
  }
  for (const double c : grid.inverse_depth) {
    if (!(std::abs(c) <= kLargest)) {
      throw std::invalid_argument("expected numbers between -0.1 and 0.1 1/m, got " +
                                  std::to_string(c));
    }
  }
}

void DepthCorrection::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  pixels_.resize(size);
  table_.resize(size);
  const auto at = [&](int column, int row) {
    return grid_.inverse_depth[static_cast<std::size_t>(row * grid_.columns + column)];
  };
  for (int v = 0; v < height; ++v) {
    const Between y(v, height, grid_.rows);
    for (int u = 0; u < width; ++u) {
      const Between x(u, width, grid_.columns);
      const double above = (1.0 - x.share) * at(x.first, y.first) + x.share * at(x.second, y.first);
      const double below =
          (1.0 - x.share) * at(x.first, y.second) + x.share * at(x.second, y.second);
      table_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(u)] =
          static_cast<float>((1.0 - y.share) * above + y.share * below);
    }
  }
  // Last: had memory not sufficed, the table would not be that of the size.
  width_ = width;
  height_ = height;
}

DepthView DepthCorrection::correct(const DepthView& depth) {
  if (depth.data == nullptr || depth.width <= 0 || depth.height <= 0) return depth;
  resize(depth.width, depth.height);
  for (int v = 0; v < depth.height; ++v) {
    const auto begin = static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width);
    const float* table = table_.data() + begin;
    float* to = pixels_.data() + begin;
    if (depth.type == DepthView::Type::kUint16) {
      correctRow(depth.row<std::uint16_t>(v), depth.metres_per_unit, table, depth.width, to);
    } else {
      correctRow(depth.row<float>(v), 1.0F, table, depth.width, to);
    }
  }
  return {pixels_.data(), depth.width, depth.height};
}

}  // namespace dominant_plane_detection
