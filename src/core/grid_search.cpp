#include "core/grid_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/label_rule.h"

namespace dominant_plane_detection {

void GridSearch::run(const Image& image, const Parameters& parameters,
                     const std::optional<HessePlane>& predicted, PlaneSelection& selection,
                     Effort& effort) {
  selection_ = &selection;
  effort_ = &effort;
  start(image, parameters);
  growth_.start(image.tiles, tileAngle(image.camera));
  // Where the lowest plane is looked for all seeds are tried, from anywhere: what up is exactly
  // changes none. At a known height the lower half shows the ground nearer, and so better.
  const PlaneLimits& limits = selection.limits();
  const bool from_anywhere = limits.lowest_from > 0 && !limits.expected_height;
  const Eigen::Vector3d no_lower_half(0.0, 0.0, -1.0);
  order_.build(tiles_->columns, tiles_->rows, {image.camera.fx, image.camera.fy},
               from_anywhere ? no_lower_half : limits.expected_up);
  begin(Seeds::kPromising);
  tracked_ = false;
  if (predicted) tryPrediction(*predicted);
  search(parameters);
  if (selection.found() || effort.seeds == 0) return;
  // Walls may have taken all the seeds; and to say why there is no ground, the planes that are none
  // have to be looked at.
  begin(Seeds::kAll);
  search(parameters);
}

void GridSearch::start(const Image& image, const Parameters& parameters) {
  tiles_ = &image.tiles;
  piece_limits_ = {parameters.join_pieces, image.min_piece};
  smooth_error_ = parameters.smooth_error;
  limits_.set(*tiles_, growthThresholds(parameters));
  judge_.start(*tiles_, limits_);
  region_.tiles.clear();
  region_.member.assign(tiles_->count.size(), 0);
  ground_tiles_.start(*tiles_, tileAngle(image.camera));
  taken_.assign(tiles_->count.size(), 0);
  other_.assign(tiles_->count.size(), 0);
}

void GridSearch::begin(Seeds seeds) {
  seeds_ = seeds;
  std::fill(taken_.begin(), taken_.end(), std::uint8_t{0});
  seeded_.assign(tiles_->count.size(), 0);
  available_points_ = 0;
  for (std::size_t tile = 0; tile < tiles_->size(); ++tile) {
    if (available(tile)) available_points_ += static_cast<std::size_t>(tiles_->count[tile]);
  }
}

void GridSearch::search(const Parameters& parameters) {
  draw_.restart(static_cast<std::uint32_t>(parameters.random_seed));
  effort_->seeds +=
      searchSeeds(order_, static_cast<std::size_t>(parameters.seeds), *selection_, draw_, *this);
}

/// Instead of a region that is grown from a seed, looks at what lies on the plane and hangs
/// together with the middle of it; all else is as with any region.
void GridSearch::tryPrediction(const HessePlane& plane) {
  constexpr double kMiddle = 2.0;  // [m] of the range, see `PlaneFrame`
  judge_.setPlane(plane, kMiddle * Eigen::Vector3d::UnitZ());
  judge_.judgeAll();
  predicted_tiles_.clear();
  std::size_t points = 0;
  for (std::size_t tile = 0; tile < tiles_->size(); ++tile) {
    if (!judge_.onPlane(tile)) continue;
    predicted_tiles_.push_back(tile);
    points += static_cast<std::size_t>(tiles_->count[tile]);
  }
  if (predicted_tiles_.empty()) return;
  const std::size_t middle = predicted_tiles_[predicted_tiles_.size() / 2];
  predicted_tiles_.assign(1, middle);
  const TileRegion& together = growth_.surround(judge_, predicted_tiles_, taken_);
  effort_->joined += together.tiles.size();
  // A piece of the plane is no better a beginning than a seed.
  if (together.points < points / 2 || together.points < selection_->minPoints() / 2) return;
  ++effort_->seeds;
  ++effort_->regions;
  predicted_region_ = together;
  predicted_region_.plane = plane;
  predicted_ = true;
  finishRegion(predicted_region_);
  predicted_ = false;
}

void GridSearch::collectGround(const Image& image, const Parameters& parameters,
                               const HessePlane& plane, const std::vector<std::size_t>& region) {
  start(image, parameters);
  other_surfaces_.assign(tiles_->count.size(), 0);
  const bool any = collectSurface({plane, std::numeric_limits<float>::infinity(), 0}, region);
  if (any) {
    ground_ = ground_tiles_.ground();
  } else {
    ground_.assign(tiles_->count.size(), 0);
  }
}

void GridSearch::take(std::size_t tile) {
  if (taken_[tile]) return;
  taken_[tile] = 1;
  available_points_ -= static_cast<std::size_t>(tiles_->count[tile]);
}

bool GridSearch::tryRegion(std::size_t tile) {
  seeded_[tile] = 1;
  const std::optional<TileSeed> seed = fitSeed(judge_, taken_, tile);
  ++effort_->fits;
  if (!seed) return true;
  if (seeds_ == Seeds::kPromising && selection_->clearlyTooTilted(seed->fit.plane)) {
    std::for_each_n(seed->tiles.begin(), seed->count, [&](std::size_t t) { take(t); });
    return true;
  }
  const TileRegion& grown = growth_.grow(judge_, *seed, taken_);
  ++effort_->regions;
  effort_->joined += grown.tiles.size();
  effort_->fits += growth_.fits();
  effort_->tests += growth_.tests();
  if (grown.points < selection_->toBeat() / 2) {
    // What is far from being the largest even now will not become so.
    selection_->consider(grown.plane, grown.points);
  } else {
    finishRegion(grown);
  }
  return true;
}

/// Keeps the surfaces of what was grown as one: more than one, if they differ by less than gamma.
void GridSearch::finishRegion(const TileRegion& grown) {
  std::fill(other_.begin(), other_.end(), std::uint8_t{0});
  finishPart(grown, kMaxSplits);
}

/// @param splits how often the part may be told into two surfaces.
void GridSearch::finishPart(const TileRegion& part, int splits) {
  const std::optional<SurfacePlane> surface = decideAgain(part);
  if (!surface) return;
  region_.plane = surface->plane;
  if (splits > 0) {
    around_.fill(ground_tiles_.ground(), *tiles_);
    around_.plane = region_.plane;
    if (split_.find(judge_, around_, smooth_error_)) {
      finishSides(splits - 1);
      return;
    }
  }
  finishSurface(*surface, splits < kMaxSplits);
}

/// Each surface without the other one's tiles.
void GridSearch::finishSides(int splits) {
  Parts& parts = parts_[static_cast<std::size_t>(splits)];
  parts.sides = split_.sides();
  parts.other = other_;
  for (std::size_t i = 0; i < parts.sides.size(); ++i) {
    other_ = parts.other;
    for (const std::size_t tile : parts.sides[1 - i].tiles) {
      other_[tile] = static_cast<std::uint8_t>(splits + 1);
    }
    finishPart(parts.sides[i], splits);
  }
}

/// Keeps a region that is a surface, with the pieces of its plane.
/// @param is_level whether it is one of several surfaces.
void GridSearch::finishSurface(const SurfacePlane& surface, bool is_level) {
  if (!check_.isSurface(judge_, region_)) return;
  joinPieces(surface.level);
  effort_->joined += region_.tiles.size();
  const double nearest = is_level ? nearestPoint() : std::numeric_limits<double>::infinity();
  const State verdict = selection_->consider(region_.plane, region_.points, nearest, centre());
  // A surface that is no ground may have been put together from parts of one that is.
  if (verdict != State::kFound && seeds_ == Seeds::kPromising) return;
  for (const std::size_t tile : region_.tiles) take(tile);
  if (!selection_->tookLast()) return;
  tracked_ = predicted_;
  ground_ = ground_tiles_.ground();
  if (is_level) {
    placeOtherSurfaces();
  } else {
    other_surfaces_.assign(other_.size(), 0);
  }
}

/// Finds out on which side of the region's plane most of each of the other surfaces is. One that is
/// on neither by as much as sigma(z) is the same floor, which the sensor's error bends.
void GridSearch::placeOtherSurfaces() {
  other_surfaces_.assign(other_.size(), 0);
  std::array<double, kMaxSplits + 1> over{}, sigma{};  // [m] summed over points
  const HessePlane& plane = region_.plane;
  for (std::size_t tile = 0; tile < tiles_->size(); ++tile) {
    if (other_[tile] == 0) continue;
    const auto points = static_cast<double>(tiles_->count[tile]);
    over[other_[tile]] -= points * plane.signedDistance(tiles_->centre(tile));
    sigma[other_[tile]] += points / static_cast<double>(limits_.inverse_sigma[tile]);
  }
  for (std::size_t tile = 0; tile < tiles_->size(); ++tile) {
    const std::uint8_t surface = other_[tile];
    if (surface == 0 || std::abs(over[surface]) < sigma[surface]) continue;
    other_surfaces_[tile] = over[surface] > 0.0 ? kAbove : kBelow;
  }
}

/// @return [m] the mean of the region's points.
Eigen::Vector3d GridSearch::centre() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double points = 0.0;
  for (const std::size_t tile : region_.tiles) {
    const auto count = static_cast<double>(tiles_->count[tile]);
    sum += count * tiles_->centre(tile);
    points += count;
  }
  return sum / std::max(points, 1.0);
}

/// @return [m] from the camera's foot on the region's plane to the nearest of its tiles.
double GridSearch::nearestPoint() const {
  const Eigen::Vector3d& normal = region_.plane.normal;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t tile : region_.tiles) {
    const Eigen::Vector3d centre = tiles_->centre(tile);
    least = std::min(least, (centre - centre.dot(normal) * normal).squaredNorm());
  }
  return std::sqrt(least);
}

/// Looks for the one surface in what was grown, and decides again what belongs to it. What is much
/// more than was grown may show another surface.
/// @return the plane fitted to the region.
std::optional<SurfacePlane> GridSearch::decideAgain(const TileRegion& grown) {
  constexpr double kMuchMore = 1.5;
  std::optional<SurfacePlane> surface = findSurface(judge_, grown);
  std::size_t before = grown.points;
  if (!surface || !collectSurface(*surface, grown.tiles)) return std::nullopt;
  while (static_cast<double>(region_.points) > kMuchMore * static_cast<double>(before)) {
    effort_->fits += surface->fits;
    before = region_.points;
    surface = findSurface(judge_, region_);
    tiles_so_far_ = region_.tiles;
    if (!surface || !collectSurface(*surface, tiles_so_far_)) return std::nullopt;
  }
  const std::optional<SurfacePlane> fit = fitPlane(judge_, region_, surface->plane, surface->level);
  effort_->fits += surface->fits + (fit ? fit->fits : 0);
  return fit;
}

bool GridSearch::collectSurface(const SurfacePlane& surface,
                                const std::vector<std::size_t>& grown) {
  return ground_tiles_.collectSurface(judge_, surface, grown, piece_limits_, other_, region_);
}

/// Pieces beyond a gap say more about the plane than the region alone, and the plane more about
/// what is ground.
void GridSearch::joinPieces(float level) {
  if (ground_tiles_.pieces().empty()) return;
  for (const std::size_t tile : ground_tiles_.pieces()) region_.add(tile, *tiles_);
  const std::optional<SurfacePlane> joint = fitPlane(judge_, region_, region_.plane, level);
  if (!joint) return;
  tiles_so_far_ = region_.tiles;
  collectSurface({joint->plane, level, 0}, tiles_so_far_);
}

}  // namespace dominant_plane_detection
