#include "navigation/upright_box.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dominant_plane_detection {
namespace {

constexpr float kBin = 0.01F;                  // [m] in which extents are told
constexpr float kTrimmed = 0.005F;             // [-] of the points at each end
constexpr int kDirections = 18;                // [#] 5 degrees apart
constexpr std::ptrdiff_t kLeastOfMany = 1000;  // [#] points that are looked at

}  // namespace

/// @param value of a point. @return the values without `kTrimmed` at each end.
template <typename Value>
BoxFitter::Extent BoxFitter::extentOf(Value&& value) {
  values_.clear();
  for (const ObstaclePoint& point : sample_) values_.push_back(value(point));
  const auto [lowest, highest] = std::minmax_element(values_.begin(), values_.end());
  const float begin = *lowest, end = *highest;
  bins_.assign(static_cast<std::size_t>((end - begin) / kBin) + 1, 0);
  for (const float v : values_) ++bins_[static_cast<std::size_t>((v - begin) / kBin)];
  const int trimmed = static_cast<int>(kTrimmed * static_cast<float>(values_.size()));
  std::size_t low = 0, high = bins_.size() - 1;
  for (int left = trimmed - bins_[low]; left >= 0 && low < high; left -= bins_[++low]) {
  }
  for (int left = trimmed - bins_[high]; left >= 0 && high > low; left -= bins_[--high]) {
  }
  return {begin + kBin * static_cast<float>(low),
          std::min(end, begin + kBin * static_cast<float>(high + 1))};
}

UprightBox BoxFitter::fit(const ObstaclePoint* first, const ObstaclePoint* last) {
  sample_.clear();
  const std::ptrdiff_t step = std::max<std::ptrdiff_t>((last - first) / kLeastOfMany, 1);
  for (std::ptrdiff_t i = 0; i < last - first; i += step) sample_.push_back(first[i]);
  Extent along, across;
  float least = INFINITY, yaw = 0.0F;
  for (int k = 0; k < kDirections; ++k) {
    const float angle = static_cast<float>(k) * static_cast<float>(0.5 * M_PI / kDirections);
    const float c = std::cos(angle), s = std::sin(angle);
    const Extent a = extentOf([c, s](const ObstaclePoint& p) { return c * p.x + s * p.y; });
    const Extent b = extentOf([c, s](const ObstaclePoint& p) { return c * p.y - s * p.x; });
    const float size = (a.size() + kBin) * (b.size() + kBin);  // a wall has no width
    if (size >= least) continue;
    least = size, yaw = angle, along = a, across = b;
  }
  UprightBox box;
  box.centre = Eigen::Rotation2Dd(static_cast<double>(yaw)) *
               Eigen::Vector2f(along.middle(), across.middle()).cast<double>();
  box.length = static_cast<double>(std::max(along.size(), across.size()));
  box.width = static_cast<double>(std::min(along.size(), across.size()));
  box.yaw = static_cast<double>(yaw) - (across.size() > along.size() ? 0.5 * M_PI : 0.0);
  const Extent heights = extentOf([](const ObstaclePoint& p) { return p.height; });
  box.bottom = static_cast<double>(heights.low);
  box.top = static_cast<double>(heights.high);
  const Extent ranges = extentOf([](const ObstaclePoint& p) { return std::hypot(p.x, p.y); });
  box.distance = static_cast<double>(ranges.low);
  constexpr int kPixels = ConnectedObstacles::kStep * ConnectedObstacles::kStep;
  box.pixels = static_cast<std::size_t>(last - first) * kPixels;
  return box;
}

}  // namespace dominant_plane_detection
