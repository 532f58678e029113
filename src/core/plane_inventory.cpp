#include "core/plane_inventory.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "core/plane_index.h"
#include "core/plane_kind.h"
#include "core/widen_tiles.h"

namespace dominant_plane_detection {
namespace {

constexpr auto kGroundLabel = static_cast<std::uint8_t>(Label::kGround);
constexpr std::uint8_t kNone = 0, kDominant = 1;

/// [#] of the largest further planes, among which ramps are looked for.
constexpr std::size_t kLookedAt = 8;

std::size_t lookedAt(const Parameters& parameters) {
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
  if (parameters.covariance && parameters.max_planes > 1) {
    further.covariance = covariance_.estimate(image.tiles, plane.tiles, plane.plane,
                                              errorSizes(parameters), image.input.depth.width);
  }
  return further;
}

/// Numbers the pixels of one plane after the other, until there are as many as are looked at.
void PlaneInventory::collect(const Image& image, const Parameters& parameters,
                             Detection& detection) {
  std::vector<std::uint8_t>& index = detection.plane_index;
  // Half of a small surface may be its rim.
  const FurtherPlanes::Limits wanted{image.min_points / 2, growthThresholds(parameters),
                                     image.pieces};
  const std::size_t most = lookedAt(parameters);
  std::uint8_t number = kDominant;
  for (const TilePlane& plane :
       search_.find(image.tiles, tileAngle(image.input.rays.camera()), image.region, wanted)) {
    if (detection.further_planes.size() == most) return;
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
    detection.further_planes.push_back(further);
    if (further.kind == PlaneKind::kRamp &&
        slopeOf(image.ground, plane.plane) <= parameters.max_ramp &&
        joinsGround(plane, image.region, image.tiles, search_.limits())) {
      makeGround(number, detection);
    }
  }
}

/// Sorts planes by their inliers, renumbers their pixels, and leaves out what is too many.
void PlaneInventory::rank(std::size_t most, Detection& detection) {
  std::vector<FurtherPlane>& planes = detection.further_planes;
  std::vector<std::size_t> order(planes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return planes[a].inliers > planes[b].inliers;
  });
  order.resize(std::min(order.size(), most));
  std::array<std::uint8_t, 256> numbers{};
  numbers[kDominant] = kDominant;
  std::vector<FurtherPlane> ranked;
  for (const std::size_t plane : order) {
    ranked.push_back(planes[plane]);
    numbers[kDominant + 1 + plane] = static_cast<std::uint8_t>(kDominant + ranked.size());
  }
  planes = std::move(ranked);
  for (std::uint8_t& number : detection.plane_index) number = numbers[number];
}

void PlaneInventory::tell(const Image& image, const Parameters& parameters, Detection& detection) {
  if (lookedAt(parameters) == 0) return;
  std::vector<std::uint8_t>& index = detection.plane_index;
  index.resize(detection.labels.size());
  std::transform(detection.labels.begin(), detection.labels.end(), index.begin(),
                 [](std::uint8_t label) { return label == kGroundLabel ? kDominant : kNone; });
  collect(image, parameters, detection);
  rank(static_cast<std::size_t>(parameters.max_planes - 1), detection);
}

}  // namespace dominant_plane_detection
