#include "core/grid_region_growing.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/plane_refinement_kernel.h"
#include "core/tile_neighbours.h"

namespace dominant_plane_detection {
namespace {

/// A tile with fewer readings lies on an edge, or the sensor is guessing there.
constexpr float kMinFill = 0.5F;
/// How many standard deviations about a tile's mean stand for "its points".
constexpr double kSpread = 2.0;
/// The plane is fitted again whenever the region has grown by this factor.
constexpr double kRefitGrowth = 1.25;
/// What is not worth a fit of its own: a tile farther off than this many times gamma, and one that
/// would be a smaller share of the region than this, which cannot turn the plane towards itself.
constexpr double kHopeless = 1.5;
constexpr double kNoticeable = 0.05;
/// Tiles that a region starts from, its seed among them: three times three, less a third.
constexpr std::size_t kMinStart = 6;
/// A plane has settled when growing by kRefitGrowth moves it by less than this share of gamma.
constexpr double kSettled = 0.1;
/// Steps of the refinement; a plane that moves by less than the last two numbers, far below any
/// sensor's noise, is final.
constexpr int kRefineSteps = 6;
constexpr double kFinalNormal = 1e-4;    // [rad]
constexpr double kFinalDistance = 1e-4;  // [m]

/// Smallest reciprocal condition of the normal equations that still tell a plane.
constexpr double kMinCondition = 1e-7;

/// @return the frame of a plane about its point nearest to `centre`.
PlaneFrame frameOf(const HessePlane& plane, const Eigen::Vector3d& centre) {
  const Eigen::Vector3d& n = plane.normal;
  const Eigen::Vector3d a = n.unitOrthogonal();
  PlaneFrame frame;
  frame.origin = (centre - plane.signedDistance(centre) * n).cast<float>();
  frame.axes << a.cast<float>(), n.cross(a).cast<float>(), n.cast<float>();
  return frame;
}

}  // namespace

void GridRegionGrowing::start(const TileMoments& tiles, const GrowthThresholds& thresholds) {
  tiles_ = &tiles;
  noise_ = thresholds.noise;
  min_count_ = kMinFill * kTileSize * kTileSize;
  const std::size_t size = tiles.size();
  for (auto* values : {&delta_, &epsilon2_, &gamma_, &radius_, &weight_}) {
    values->resize(tiles.count.size());
  }
  on_plane_.resize(tiles.count.size());
  gamma_of_z_ = thresholds.gamma;
  nearest_ = std::numeric_limits<double>::infinity();
  farthest_ = 0.0;
  claimed_.assign(tiles.count.size(), 0);
  joined_.assign(size, 0);
  growth_ = 0;
  available_points_ = 0;
  for (std::size_t tile = 0; tile < size; ++tile) {
    const double z = static_cast<double>(tiles.z[tile]);
    const double epsilon = thresholds.epsilon.at(z, noise_);
    delta_[tile] = static_cast<float>(thresholds.delta.at(z, noise_));
    epsilon2_[tile] = static_cast<float>(epsilon * epsilon);
    gamma_[tile] = static_cast<float>(thresholds.gamma.at(z, noise_));
    // Points spread evenly over a length have a variance of a third of its half squared.
    radius_[tile] = std::sqrt(3.0F * (tiles.xx[tile] + tiles.yy[tile] + tiles.zz[tile]));
    const double sigma = noise_.sigma(z);
    weight_[tile] = static_cast<float>(1.0 / (sigma * sigma));
    if (!usable(tile)) continue;
    available_points_ += static_cast<std::size_t>(tiles.count[tile]);
    nearest_ = std::min(nearest_, z);
    farthest_ = std::max(farthest_, z);
  }
}

GridRegionGrowing::Height GridRegionGrowing::height(std::size_t tile,
                                                    const HessePlane& plane) const {
  const TileMoments& t = *tiles_;
  const Eigen::Vector3d& n = plane.normal;
  const double variance =
      n.x() * (n.x() * t.xx[tile] + 2.0 * (n.y() * t.xy[tile] + n.z() * t.xz[tile])) +
      n.y() * (n.y() * t.yy[tile] + 2.0 * n.z() * t.yz[tile]) + n.z() * n.z() * t.zz[tile];
  return {plane.signedDistance(t.centre(tile)), std::max(variance, 0.0)};
}

bool GridRegionGrowing::within(const Height& height, double limit) const {
  const double rest = limit - std::abs(height.mean);
  return rest > 0.0 && kSpread * kSpread * height.variance < rest * rest;
}

/// Whether the points of two tiles come closer than delta, as if they were spread evenly about
/// their centres.
bool GridRegionGrowing::close(std::size_t tile, std::size_t neighbour) const {
  const float reach = delta_[tile] + radius_[tile] + radius_[neighbour];
  const float dx = tiles_->x[tile] - tiles_->x[neighbour];
  const float dy = tiles_->y[tile] - tiles_->y[neighbour];
  const float dz = tiles_->z[tile] - tiles_->z[neighbour];
  return dx * dx + dy * dy + dz * dz < reach * reach;
}

void GridRegionGrowing::claim(std::size_t tile) {
  if (claimed_[tile]) return;
  claimed_[tile] = 1;
  if (usable(tile)) available_points_ -= static_cast<std::size_t>(tiles_->count[tile]);
}

void GridRegionGrowing::claimTilesOnPlane() {
  for (std::size_t i = 0; i < on_plane_.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, &on_plane_[i], sizeof(eight));
    if (eight == 0) continue;  // most of them, where the plane is small
    for (std::size_t tile = i; tile < i + sizeof(eight); ++tile) {
      if (on_plane_[tile]) claim(tile);
    }
  }
}

void GridRegionGrowing::join(std::size_t tile) {
  const double count = static_cast<double>(tiles_->count[tile]);
  moments_.add(count, tiles_->centre(tile), tiles_->scatter(tile));
  sum_epsilon2_ += count * static_cast<double>(epsilon2_[tile]);
  joined_[tile] = growth_;
  region_.push_back(tile);
}

bool GridRegionGrowing::refit() {
  const std::optional<PlaneFit> fit = moments_.fit();
  if (!fit) return false;
  fit_ = *fit;
  fitted_count_ = moments_.count();
  return true;
}

/// Whether the plane is so close to an earlier one that tiles at any depth are judged alike.
bool GridRegionGrowing::settled(const HessePlane& before) const {
  const double turned = (fit_.plane.normal - before.normal).norm();
  const double moved = std::abs(fit_.plane.distance - before.distance);
  const auto small = [&](double z) {
    return turned * z + moved < kSettled * gamma_of_z_.at(z, noise_);
  };
  return small(nearest_) && small(farthest_);
}

/// The region's first plane: a tile is too small to give one that holds far beyond it, the nine
/// tiles about the seed are ten times better. Those that lie on something else are left out once.
bool GridRegionGrowing::fitSeed(std::size_t seed) {
  const auto begin = [&] {
    ++growth_;
    region_.clear();
    moments_ = PlaneMoments();
    sum_epsilon2_ = 0.0;
  };
  begin();
  join(seed);
  forEachNeighbour(seed, tiles_->columns, tiles_->rows, [&](std::size_t tile) {
    if (usable(tile) && close(tile, seed)) join(tile);
  });
  // Too few to start from, whatever they lie on.
  if (region_.size() < kMinStart || !refit()) return false;
  const auto on_plane = [&](std::size_t tile) {
    return within(height(tile, fit_.plane), static_cast<double>(gamma_[tile]));
  };
  if (!on_plane(seed)) return false;
  std::array<std::size_t, 9> kept;
  const auto kept_end = std::copy_if(region_.begin(), region_.end(), kept.begin(), on_plane);
  const auto kept_count = static_cast<std::size_t>(kept_end - kept.begin());
  if (kept_count < kMinStart) return false;
  if (kept_count < region_.size()) {
    begin();
    std::for_each(kept.begin(), kept_end, [&](std::size_t tile) { join(tile); });
    if (!refit()) return false;
  }
  return fit_.mean_square_error * moments_.count() < sum_epsilon2_;
}

bool GridRegionGrowing::tryToJoin(std::size_t tile) {
  const double count = static_cast<double>(tiles_->count[tile]);
  const double gamma = static_cast<double>(gamma_[tile]);
  const double sum_limit = sum_epsilon2_ + count * static_cast<double>(epsilon2_[tile]);
  const Height height_now = height(tile, fit_.plane);
  if (!within(height_now, kHopeless * gamma)) return false;
  // Any plane's error bounds that of the best one (lambda_min(A) <= m^T A m), so that most tiles
  // need no fit of their own. The error at the last fit still stands for the tiles since.
  const double sum_bound = fit_.mean_square_error * moments_.count() +
                           count * (height_now.variance + height_now.mean * height_now.mean);
  if (within(height_now, gamma) && sum_bound < sum_limit) return true;
  if (count < kNoticeable * moments_.count()) return false;
  PlaneMoments with_tile = moments_;
  with_tile.add(count, tiles_->centre(tile), tiles_->scatter(tile));
  const std::optional<PlaneFit> fit = with_tile.fit();
  return fit && within(height(tile, fit->plane), gamma) &&
         fit->mean_square_error * with_tile.count() < sum_limit;
}

std::optional<HessePlane> GridRegionGrowing::startRegion(std::size_t seed) {
  claim(seed);
  if (!usable(seed) || !fitSeed(seed)) return std::nullopt;
  return fit_.plane;
}

void GridRegionGrowing::claimStart() {
  for (const std::size_t tile : region_) claim(tile);
}

GridRegionGrowing::Region GridRegionGrowing::grow() {
  // First come, first served: rings about the seed, as good as "nearest first" on a grid.
  for (std::size_t i = 0; i < region_.size(); ++i) {
    const std::size_t from = region_[i];
    forEachNeighbour(from, tiles_->columns, tiles_->rows, [&](std::size_t tile) {
      if (!usable(tile) || joined_[tile] == growth_) return;
      if (close(tile, from) && tryToJoin(tile)) join(tile);
    });
    if (moments_.count() > kRefitGrowth * fitted_count_) {
      const HessePlane before = fit_.plane;
      refit();
      if (settled(before)) break;
    }
  }
  refit();
  for (const std::size_t tile : region_) claim(tile);
  return Region{fit_.plane, static_cast<std::size_t>(moments_.count())};
}

/// Gauss-Newton steps on the weighted sum of squared distances; the solution is that of the
/// weighted fit by moments.
std::optional<GridRegionGrowing::Region> GridRegionGrowing::refine(const HessePlane& plane,
                                                                   std::size_t worthwhile) {
  if (!(farthest_ > 0.0)) return std::nullopt;
  const TileRule rule{min_count_, gamma_, weight_};
  Region region{plane, 0};
  const Eigen::Vector3d centre(0.0, 0.0, 0.5 * (nearest_ + farthest_));
  for (int step = 0; step < kRefineSteps; ++step) {
    const PlaneFrame frame = frameOf(region.plane, centre);
    const PlaneResiduals residuals = runPlaneRefinementKernel(*tiles_, rule, frame, on_plane_);
    region.points = residuals.points;
    const Eigen::LDLT<Eigen::Matrix3d> solver(residuals.normal_matrix);
    // A single tile, or tiles in one line, do not determine a plane.
    if (residuals.points == 0 || !(solver.rcond() > kMinCondition)) return std::nullopt;
    const Eigen::Vector3d change = solver.solve(residuals.right);  // p, q, c
    const Eigen::Matrix3d axes = frame.axes.cast<double>();
    const Eigen::Vector3d normal =
        (axes.col(2) - change[0] * axes.col(0) - change[1] * axes.col(1)).normalized();
    region.plane =
        HessePlane::through(frame.origin.cast<double>() + change[2] * axes.col(2), normal);
    if (change.head<2>().norm() < kFinalNormal && std::abs(change[2]) < kFinalDistance) break;
    if (region.points < worthwhile) break;
  }
  claimTilesOnPlane();
  return region;
}

}  // namespace dominant_plane_detection
