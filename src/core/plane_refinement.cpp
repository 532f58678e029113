#include "core/plane_refinement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dominant_plane_detection {
namespace {

/// [-] Width of the weights in sigma(z) that look for the densest heights, and steps with it.
constexpr float kWidth = 0.2F;
constexpr int kModeSteps = 3;
/// Planes through three of the region's tiles that are tried, on this many of the tiles. Three of
/// them lie on a surface that holds half of the region with 1 - (7/8)^32 = 99 %.
constexpr std::size_t kHypotheses = 32;
constexpr std::size_t kSample = 256;
/// Steps of the least squares; a plane that moves by less than the last two numbers, far below any
/// sensor's noise, is final.
constexpr int kMaxSteps = 4;
constexpr double kFinalNormal = 1e-4;    // [rad]
constexpr double kFinalDistance = 1e-4;  // [m]
/// Smallest reciprocal condition of the normal equations that still tell a plane.
constexpr double kMinCondition = 1e-7;
/// [-] A quarter of normally distributed numbers is within this many standard deviations.
constexpr float kQuartile = 0.3186F;
/// [-] Standard deviations that belong to the surface; the scatter may double with distance.
constexpr float kScatters = 3.0F;
/// [-] Smallest level in sigma(z); the scatter of exact readings is 0.
constexpr float kMinLevel = 0.3F;

struct Step {
  HessePlane plane;
  bool final;
};

/// A Gauss-Newton step on the weighted sum of squared distances; the solution is that of the
/// weighted fit by moments.
std::optional<Step> step(const TileJudge& judge, const TileRegion& region, const HessePlane& plane,
                         float level, float width) {
  const Eigen::Vector3d centre = judge.tiles().centre(region.tiles.front());
  const PlaneTest test{PlaneFrame::of(plane, centre), level};
  const PlaneResiduals residuals =
      runResidualKernel(judge.tiles(), judge.limits(), test, width, region.member);
  const Eigen::LDLT<Eigen::Matrix3d> solver(residuals.normal_matrix);
  // A single tile, or tiles in one line, do not determine a plane.
  if (residuals.points == 0 || !(solver.rcond() > kMinCondition)) return std::nullopt;
  const Eigen::Vector3d change = solver.solve(residuals.right);  // p, q, c
  const Eigen::Matrix3d axes = test.frame.axes.cast<double>();
  const Eigen::Vector3d normal =
      (axes.col(2) - change[0] * axes.col(0) - change[1] * axes.col(1)).normalized();
  const Eigen::Vector3d origin = test.frame.origin.cast<double>() + change[2] * axes.col(2);
  return Step{HessePlane::through(origin, normal),
              change.head<2>().norm() < kFinalNormal && std::abs(change[2]) < kFinalDistance};
}

/// Some of a region's tiles, side by side.
struct Sample {
  std::array<Eigen::Vector3f, kSample> centre;  ///< [m]
  std::array<float, kSample> inverse_width;     ///< [1/m]
  std::array<float, kSample> points;            ///< [px]
  std::size_t size = 0;

  Sample(const TileJudge& judge, const TileRegion& region) {
    size = std::min(region.tiles.size(), kSample);
    const TileMoments& tiles = judge.tiles();
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t tile = region.tiles[i * region.tiles.size() / size];
      centre[i] = {tiles.x[tile], tiles.y[tile], tiles.z[tile]};
      inverse_width[i] = judge.limits().inverse_sigma[tile] / kWidth;
      points[i] = tiles.count[tile];
    }
  }

  /// @return [-] the standard deviation of the tiles' heights over a plane in sigma(z), judged
  /// where they are densest: by the quarter of them that is nearest to it.
  float scatter(const Eigen::Vector3f& normal, float distance) const {
    std::array<float, kSample> off{};
    for (std::size_t i = 0; i < size; ++i) {
      off[i] = std::abs(normal.dot(centre[i]) - distance) * inverse_width[i] * kWidth;
    }
    const auto quarter = off.begin() + static_cast<std::ptrdiff_t>(size / 4);
    std::nth_element(off.begin(), quarter, off.begin() + static_cast<std::ptrdiff_t>(size));
    return *quarter / kQuartile;
  }

  /// @return [px] that lie on a plane, those off it counting the less the farther they are.
  float support(const Eigen::Vector3f& normal, float distance) const {
    float sum = 0.0F;
    for (std::size_t i = 0; i < size; ++i) {
      const float off = (normal.dot(centre[i]) - distance) * inverse_width[i];
      sum += points[i] / (1.0F + off * off);
    }
    return sum;
  }
};

/// @return of the region's plane and of planes through three of its tiles, that with most support.
HessePlane mostSupported(const Sample& sample, const TileRegion& region) {
  HessePlane best = region.plane;
  float best_support = sample.support(best.normal.cast<float>(), static_cast<float>(best.distance));
  // Even in three dimensions: M. Roberts' generalisation of the golden ratio, x^4 = x + 1.
  constexpr double kRatio = 1.2207440846057596;
  for (std::size_t k = 1; k <= kHypotheses; ++k) {
    const auto pick = [&](double step) {
      const double whole = static_cast<double>(k) * step;
      return static_cast<std::size_t>((whole - std::floor(whole)) *
                                      static_cast<double>(sample.size));
    };
    const Eigen::Vector3f& a = sample.centre[pick(1.0 / kRatio)];
    const Eigen::Vector3f& b = sample.centre[pick(1.0 / (kRatio * kRatio))];
    const Eigen::Vector3f& c = sample.centre[pick(1.0 / (kRatio * kRatio * kRatio))];
    const Eigen::Vector3f across = (b - a).cross(c - a);
    const float area = across.norm();
    if (!(area > 0.0F)) continue;  // one tile twice, or three in a line
    const Eigen::Vector3f normal = across / area;
    const float support = sample.support(normal, normal.dot(a));
    if (support <= best_support) continue;
    best_support = support;
    best = HessePlane::through(a.cast<double>(), normal.cast<double>().normalized());
  }
  return best;
}

}  // namespace

std::optional<SurfacePlane> fitPlane(const TileJudge& judge, const TileRegion& region,
                                     const HessePlane& start, float level) {
  SurfacePlane result{start, level, 0};
  for (bool final = false; !final && result.fits < kMaxSteps; ++result.fits) {
    const auto next =
        step(judge, region, result.plane, level, std::numeric_limits<float>::infinity());
    if (!next) return std::nullopt;
    result.plane = next->plane;
    final = next->final;
  }
  return result;
}

std::optional<SurfacePlane> findSurface(const TileJudge& judge, const TileRegion& region) {
  constexpr float kAll = std::numeric_limits<float>::infinity();
  const Sample sample(judge, region);
  SurfacePlane surface{mostSupported(sample, region), kAll, 0};
  for (bool final = false; !final && surface.fits < kModeSteps; ++surface.fits) {
    const auto next = step(judge, region, surface.plane, kAll, kWidth);
    if (!next) return std::nullopt;
    surface.plane = next->plane;
    final = next->final;
  }
  const float scatter = sample.scatter(surface.plane.normal.cast<float>(),
                                       static_cast<float>(surface.plane.distance));
  surface.level = std::max(kMinLevel, kScatters * scatter);
  const auto fit = fitPlane(judge, region, surface.plane, surface.level);
  if (!fit) return std::nullopt;
  return SurfacePlane{fit->plane, surface.level, surface.fits + fit->fits};
}

}  // namespace dominant_plane_detection
