#include "core/kdtree_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/tile_moments.h"

namespace dominant_plane_detection {
namespace {

/// [#] subsampled pixels to either side of r1 from which r2 and r3 are drawn.
constexpr int kSeedWindow = 8;

}  // namespace

void KdtreeSearch::collectPoints(const ImageInput& input, int subsampling) {
  columns_ = (input.depth.width + subsampling - 1) / subsampling;
  rows_ = (input.depth.height + subsampling - 1) / subsampling;
  image_width_ = input.depth.width;
  subsampling_ = subsampling;
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

bool KdtreeSearch::available(std::size_t cell) const {
  return point_of_[cell] >= 0 && !growing_.claimed(static_cast<std::size_t>(point_of_[cell]));
}

std::size_t KdtreeSearch::availablePoints() const {
  return growing_.unclaimed() * pixels_per_point_;
}

bool KdtreeSearch::exhausted() const {
  constexpr std::size_t kSearches = 4;  // [#] a point; more find little each
  return growing_.effort().tests >= points_.size() ||
         growing_.effort().searches >= kSearches * points_.size();
}

/// Draws r2 and r3 from the window about r1.
/// @return false where the window holds too few points.
bool KdtreeSearch::drawSeeds(std::size_t cell, std::array<std::size_t, 3>& seeds) {
  const int column = static_cast<int>(cell) % columns_;
  const int row = static_cast<int>(cell) / columns_;
  const auto draw_near = [&](int middle, int end) {
    const int low = std::max(middle - kSeedWindow, 0);
    const int high = std::min(middle + kSeedWindow, end - 1);
    return low + static_cast<int>(draw_.below(static_cast<std::size_t>(high - low + 1)));
  };
  seeds[0] = static_cast<std::size_t>(point_of_[cell]);
  std::size_t drawn = 1;
  constexpr int kAttempts = 50;
  for (int attempt = 0; attempt < kAttempts && drawn < seeds.size(); ++attempt) {
    const auto pixel =
        static_cast<std::size_t>(draw_near(row, rows_) * columns_ + draw_near(column, columns_));
    if (!available(pixel)) continue;
    const auto drawn_end = seeds.begin() + static_cast<std::ptrdiff_t>(drawn);
    const auto seed = static_cast<std::size_t>(point_of_[pixel]);
    if (std::find(seeds.begin(), drawn_end, seed) == drawn_end) seeds[drawn++] = seed;
  }
  return drawn == seeds.size();
}

/// Regions that are clearly too tilted are given up, but not before something was found: until then
/// they say why nothing is.
bool KdtreeSearch::tryRegion(std::size_t cell) {
  std::array<std::size_t, 3> seeds{};
  if (!drawSeeds(cell, seeds)) return false;
  bool given_up = false;
  const auto worthwhile = [&](const PlaneMoments& moments) {
    const auto fit = moments.fit();
    given_up = selection_->found() && (!fit || selection_->clearlyTooTilted(fit->plane));
    return !given_up;
  };
  const KdtreeRegionGrowing::Region& region = growing_.grow(seeds, thresholds_, worthwhile);
  if (!given_up) ++effort_->regions;
  effort_->joined += region.sequence.size();
  const auto fit = region.moments.fit();
  if (fit) selection_->consider(fit->plane, region.sequence.size() * pixels_per_point_);
  if (fit && selection_->tookLast()) region_ = region.sequence;
  return true;
}

std::vector<std::size_t> KdtreeSearch::regionTiles() const {
  const auto tile_columns = static_cast<std::size_t>(covering(image_width_, kTileSize));
  std::vector<std::size_t> tiles;
  for (const std::size_t point : region_) {
    const auto pixel = static_cast<int>(pixel_of_[point]);
    const int u = pixel % columns_ * subsampling_, v = pixel / columns_ * subsampling_;
    tiles.push_back(static_cast<std::size_t>(v / kTileSize) * tile_columns +
                    static_cast<std::size_t>(u / kTileSize));
  }
  std::sort(tiles.begin(), tiles.end());
  tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
  return tiles;
}

void KdtreeSearch::run(const ImageInput& input, const Parameters& parameters,
                       PlaneSelection& selection, Effort& effort) {
  collectPoints(input, parameters.subsampling);
  growing_.setPoints(points_);
  thresholds_ = growthThresholds(parameters);
  selection_ = &selection;
  effort_ = &effort;
  pixels_per_point_ = static_cast<std::size_t>(parameters.subsampling) *
                      static_cast<std::size_t>(parameters.subsampling);
  const CameraModel& camera = input.rays.camera();
  order_.build(columns_, rows_, {camera.fx, camera.fy}, selection.limits().expected_up);
  draw_.restart(static_cast<std::uint32_t>(parameters.random_seed));
  effort.seeds +=
      searchSeeds(order_, static_cast<std::size_t>(parameters.seeds), selection, draw_, *this);
  effort.tests += growing_.effort().tests;
  effort.fits += growing_.effort().decompositions;
  effort.searches += growing_.effort().searches;
}

}  // namespace dominant_plane_detection
