#include "core/plane_inventory.h"

#include <algorithm>

#include "core/plane_index.h"
#include "core/plane_kind.h"
#include "core/widen_tiles.h"

namespace dominant_plane_detection {
namespace {

constexpr auto kGroundLabel = static_cast<std::uint8_t>(Label::kGround);
constexpr std::uint8_t kNone = 0, kDominant = 1;

/// [#] of the largest further planes, among which ramps are looked for.
constexpr std::size_t kLookedAt = 8;

std::size_t searched(const Parameters& parameters) {
  const auto asked = static_cast<std::size_t>(parameters.max_planes - 1);
  return parameters.max_ramp > 0.0 ? std::max(asked, kLookedAt) : asked;
}

void makeGround(std::uint8_t number, Detection& detection) {
  for (std::size_t i = 0; i < detection.labels.size(); ++i) {
    if (detection.plane_index[i] == number) detection.labels[i] = kGroundLabel;
  }
}

}  // namespace

FurtherPlane PlaneInventory::describe(const Image& image, const Parameters& parameters,
                                      const TilePlane& plane) {
  FurtherPlane further;
  further.kind = kindOf(image.ground, plane, image.tiles, parameters.ground_band, parameters.noise);
  further.normal = -plane.plane.normal;
  further.distance = plane.plane.distance;
  further.covariance = Detection::unknownCovariance();
  if (parameters.covariance) {
    further.covariance =
        covariance_.estimate(image.tiles, plane.tiles, plane.plane,
                             {parameters.noise, parameters.smooth_error, parameters.wide_error},
                             image.input.depth.width);
  }
  return further;
}

void PlaneInventory::tell(const Image& image, const Parameters& parameters, Detection& detection) {
  detection.further_planes.clear();
  detection.plane_index.clear();
  const std::size_t most = searched(parameters);
  if (most == 0) return;
  std::vector<std::uint8_t>& index = detection.plane_index;
  index.resize(detection.labels.size());
  std::transform(detection.labels.begin(), detection.labels.end(), index.begin(),
                 [](std::uint8_t label) { return label == kGroundLabel ? kDominant : kNone; });
  const CameraModel& camera = image.input.rays.camera();
  const double tile_angle = kTileSize / std::max(camera.fx, camera.fy);
  // Half of a small surface may be its rim.
  const FurtherPlanes::Limits wanted{most, image.min_points / 2, growthThresholds(parameters),
                                     image.pieces};
  std::uint8_t number = kDominant;
  for (const TilePlane& plane : search_.find(image.tiles, tile_angle, image.region, wanted)) {
    ++number;
    widenTiles(image.tiles.columns, image.tiles.rows, plane.tiles, in_row_, around_);
    const PlaneShare share = numberPixels(image.input, plane.plane, around_, parameters.gamma,
                                          parameters.noise, number, index);
    if (share.points < image.min_points) {
      std::replace(index.begin(), index.end(), number--, kNone);
      continue;
    }
    FurtherPlane further = describe(image, parameters, plane);
    further.inliers = share.points;
    further.mean_square_error = share.mean_square_error;
    if (further.kind == PlaneKind::kRamp &&
        slopeOf(image.ground, plane.plane) <= parameters.max_ramp &&
        joinsGround(plane, image.region, image.tiles, search_.limits())) {
      makeGround(number, detection);
    }
    if (number <= parameters.max_planes) detection.further_planes.push_back(further);
  }
  if (parameters.max_planes == 1) {
    index.clear();
  } else {
    std::replace_if(
        index.begin(), index.end(), [&](std::uint8_t n) { return n > parameters.max_planes; },
        std::uint8_t{0});
  }
}

}  // namespace dominant_plane_detection
