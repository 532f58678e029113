#include "core/plane_kind.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/tile_neighbours.h"

namespace dominant_plane_detection {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr double kSteepest = 45.0 * kDegree;  // [rad] of a ramp
constexpr double kSteep = 5.0 * kDegree;      // [rad] more than errors tilt a level plane
constexpr double kLevel = 1.5 * kDegree;      // [rad] less is level, whatever its heights
constexpr double kOff = 3.0;                  // [-] in sigma(z)
constexpr double kRise = 0.5;  // [-] of a ramp's mean height, from its lowest tile to its highest
constexpr double kHighestStep = 0.35;  // [m]
constexpr int kContacts = 3;           // [#] pairs of tiles

/// Heights of a plane's tiles over the ground.
struct Heights {
  double lowest = std::numeric_limits<double>::infinity();    ///< [m]
  double highest = -std::numeric_limits<double>::infinity();  ///< [m]
  double sum = 0.0, depth = 0.0, points = 0.0;                ///< weighted by points

  double mean() const { return sum / points; }                                      ///< [m]
  double nearest() const { return std::min(std::abs(lowest), std::abs(highest)); }  ///< [m]
  double meanDepth() const { return depth / points; }                               ///< [m]
};

Heights heightsOver(const HessePlane& ground, const TilePlane& plane, const TileMoments& tiles,
                    const NoiseModel& noise) {
  Heights heights;
  for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
    if (!plane.tiles[tile] || !(tiles.count[tile] > 0.0F)) continue;
    const Eigen::Vector3d centre = tiles.centre(tile);
    // Tiles of the rim show something else as well.
    if (std::abs(plane.plane.signedDistance(centre)) > kOff * noise.sigma(centre.z())) continue;
    const double height = -ground.signedDistance(centre);
    const auto points = static_cast<double>(tiles.count[tile]);
    heights.lowest = std::min(heights.lowest, height);
    heights.highest = std::max(heights.highest, height);
    heights.sum += points * height;
    heights.depth += points * centre.z();
    heights.points += points;
  }
  return heights;
}

}  // namespace

double slopeOf(const HessePlane& ground, const HessePlane& plane) {
  return std::acos(std::clamp(ground.normal.dot(plane.normal), -1.0, 1.0));
}

PlaneKind kindOf(const HessePlane& ground, const TilePlane& plane, const TileMoments& tiles,
                 const DepthThreshold& band, const NoiseModel& noise) {
  const double towards = slopeOf(ground, plane.plane);
  const double slope = std::min(towards, kPi - towards);  // a ceiling is level, too
  if (slope >= kSteepest) return PlaneKind::kWall;
  if (slope >= kSteep) return PlaneKind::kRamp;
  const Heights heights = heightsOver(ground, plane, tiles, noise);
  if (heights.points == 0.0) return PlaneKind::kFloor;  // thresholds without any noise
  const double ground_band = band.at(heights.meanDepth(), noise);
  if (slope >= kLevel && heights.nearest() <= ground_band &&
      heights.highest - heights.lowest >= kRise * std::abs(heights.mean())) {
    return PlaneKind::kRamp;
  }
  if (std::abs(heights.mean()) <= ground_band) return PlaneKind::kFloor;
  return std::abs(heights.mean()) <= kHighestStep ? PlaneKind::kStep : PlaneKind::kTable;
}

bool joinsGround(const TilePlane& plane, const std::vector<std::uint8_t>& ground,
                 const TileMoments& tiles, const TileLimits& limits) {
  int contacts = 0;
  for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
    if (!plane.tiles[tile] || ground[tile]) continue;
    bool touches = false;
    forEachNeighbour(tile, tiles.columns, tiles.rows, [&](std::size_t other) {
      touches = touches || (ground[other] && closerThanDelta(tiles, limits, tile, other));
    });
    if (touches && ++contacts >= kContacts) return true;
  }
  return false;
}

}  // namespace dominant_plane_detection
