#include "core/kdtree_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dominant_plane_detection {
namespace {

/// [#] subsampled pixels to either side of r1 from which r2 and r3 are drawn.
constexpr int kSeedWindow = 8;

}  // namespace

void KdtreeSearch::collectPoints(const ImageInput& input, int subsampling) {
  columns_ = (input.depth.width + subsampling - 1) / subsampling;
  rows_ = (input.depth.height + subsampling - 1) / subsampling;
  points_.clear();
  pixel_of_.clear();
  point_of_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), -1);
  for (std::size_t pixel = 0; pixel < point_of_.size(); ++pixel) {
    const int u = static_cast<int>(pixel) % columns_ * subsampling;
    const int v = static_cast<int>(pixel) / columns_ * subsampling;
    const float z = metresAt(input.depth, u, v);
    const Eigen::Vector3f ray = input.rays.ray(u, v);
    if (!(z >= input.range.min && z <= input.range.max) || std::isnan(ray.x())) continue;
    point_of_[pixel] = static_cast<std::ptrdiff_t>(points_.size());
    pixel_of_.push_back(pixel);
    points_.push_back((z * ray).cast<double>());
  }
}

/// Draws r2 and r3 from the window about r1.
/// @return false where the window holds too few points.
bool KdtreeSearch::drawSeeds(std::size_t first, std::array<std::size_t, 3>& seeds) {
  const int column = static_cast<int>(pixel_of_[first]) % columns_;
  const int row = static_cast<int>(pixel_of_[first]) / columns_;
  const auto draw_near = [&](int middle, int end) {
    const int low = std::max(middle - kSeedWindow, 0);
    const int high = std::min(middle + kSeedWindow, end - 1);
    return low + static_cast<int>(draw_.below(static_cast<std::size_t>(high - low + 1)));
  };
  seeds[0] = first;
  std::size_t drawn = 1;
  constexpr int kAttempts = 50;
  for (int attempt = 0; attempt < kAttempts && drawn < seeds.size(); ++attempt) {
    const int pixel = draw_near(row, rows_) * columns_ + draw_near(column, columns_);
    const std::ptrdiff_t point = point_of_[static_cast<std::size_t>(pixel)];
    if (point < 0) continue;
    const auto drawn_end = seeds.begin() + static_cast<std::ptrdiff_t>(drawn);
    const auto seed = static_cast<std::size_t>(point);
    if (std::find(seeds.begin(), drawn_end, seed) == drawn_end) seeds[drawn++] = seed;
  }
  return drawn == seeds.size();
}

std::size_t KdtreeSearch::run(const ImageInput& input, const Parameters& parameters,
                              PlaneSelection& selection) {
  collectPoints(input, parameters.subsampling);
  if (points_.empty()) return 0;
  growing_.setPoints(points_);
  claimed_.assign(points_.size(), 0);
  draw_.restart(static_cast<std::uint32_t>(parameters.random_seed));
  const GrowthThresholds thresholds = growthThresholds(parameters);
  const auto pixels_per_point = static_cast<std::size_t>(parameters.subsampling) *
                                static_cast<std::size_t>(parameters.subsampling);
  const auto lower_pixel = static_cast<std::size_t>(rows_ / 2) * static_cast<std::size_t>(columns_);
  const auto lower_half = static_cast<std::size_t>(
      std::lower_bound(pixel_of_.begin(), pixel_of_.end(), lower_pixel) - pixel_of_.begin());
  std::size_t unclaimed = points_.size();
  std::size_t tried = 0;
  const auto search = [&](std::size_t begin, std::size_t end) {
    draw_.setRange(begin, end);
    const std::size_t limit = tried + static_cast<std::size_t>(parameters.seeds);
    while (tried < limit && !draw_.empty() && unclaimed * pixels_per_point > selection.points()) {
      const std::size_t first = draw_.draw();
      std::array<std::size_t, 3> seeds{};
      if (claimed_[first] || !drawSeeds(first, seeds)) continue;
      ++tried;
      const KdtreeRegionGrowing::Region& region = growing_.grow(seeds, thresholds);
      for (const std::size_t point : region.sequence) {
        unclaimed -= claimed_[point] ? 0 : 1;
        claimed_[point] = 1;
      }
      const auto fit = region.moments.fit();
      if (fit) selection.consider(fit->plane, region.sequence.size() * pixels_per_point);
    }
  };
  search(lower_half, points_.size());
  if (!selection.found()) search(0, lower_half);
  return tried;
}

}  // namespace dominant_plane_detection
