#include "core/grid_search.h"

#include <algorithm>

namespace dominant_plane_detection {
namespace {

/// @return [rad] that a tile's side subtends in the middle of the image.
double tileAngle(const CameraModel& camera) { return kTileSize / std::max(camera.fx, camera.fy); }

}  // namespace

void GridSearch::run(const Image& image, const Parameters& parameters, PlaneSelection& selection,
                     Effort& effort) {
  selection_ = &selection;
  effort_ = &effort;
  start(image, parameters);
  growth_.start(image.tiles, tileAngle(image.camera));
  order_.build(tiles_->columns, tiles_->rows, {image.camera.fx, image.camera.fy},
               selection.limits().expected_up);
  search(parameters, Seeds::kPromising);
  if (selection.found() || effort.seeds == 0) return;
  // Walls may have taken all the seeds; and to say why there is no ground, the planes that are none
  // have to be looked at.
  search(parameters, Seeds::kAll);
}

void GridSearch::start(const Image& image, const Parameters& parameters) {
  tiles_ = &image.tiles;
  piece_limits_ = {parameters.join_pieces, image.min_piece};
  limits_.set(*tiles_, growthThresholds(parameters));
  judge_.start(*tiles_, limits_);
  collect_.start(*tiles_, tileAngle(image.camera));
  ground_tiles_.start(*tiles_, tileAngle(image.camera));
  taken_.assign(tiles_->count.size(), 0);
}

void GridSearch::search(const Parameters& parameters, Seeds seeds) {
  seeds_ = seeds;
  std::fill(taken_.begin(), taken_.end(), std::uint8_t{0});
  seeded_.assign(tiles_->count.size(), 0);
  available_points_ = 0;
  for (std::size_t tile = 0; tile < tiles_->size(); ++tile) {
    if (available(tile)) available_points_ += static_cast<std::size_t>(tiles_->count[tile]);
  }
  draw_.restart(static_cast<std::uint32_t>(parameters.random_seed));
  effort_->seeds +=
      searchSeeds(order_, static_cast<std::size_t>(parameters.seeds), *selection_, draw_, *this);
}

void GridSearch::collectGround(const Image& image, const Parameters& parameters,
                               const HessePlane& plane) {
  start(image, parameters);
  judge_.setPlane(plane, plane.distance * plane.normal);
  judge_.judgeAll();
  region_.tiles.clear();
  region_.points = 0;
  seen_ = taken_;
  for (std::size_t tile = 0; tile < tiles_->size(); ++tile) {
    if (judge_.onPlane(tile) && !seen_[tile]) collectPart(tile);
  }
  ground_tiles_.collect(judge_, plane, region_.tiles, taken_, piece_limits_);
  ground_ = ground_tiles_.ground();
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

/// Fits the plane to the one surface in what was grown, and decides again what belongs to it.
void GridSearch::finishRegion(const TileRegion& grown) {
  const std::optional<RefinedPlane> mode = refinePlane(judge_, grown);
  if (!mode) return;
  judge_.setPlane(mode->plane, tiles_->centre(grown.tiles.front()), mode->level);
  collectLargest(grown);
  if (region_.tiles.empty()) return;
  const std::optional<RefinedPlane> refined = fitPlane(judge_, region_, mode->plane, mode->level);
  if (!refined) return;
  effort_->fits += mode->fits + refined->fits;
  region_.plane = refined->plane;
  judge_.setPlane(region_.plane, tiles_->centre(region_.tiles.front()), mode->level);
  if (!check_.isSurface(judge_, region_)) return;
  ground_tiles_.collect(judge_, region_.plane, region_.tiles, taken_, piece_limits_);
  joinPieces(mode->level);
  effort_->joined += region_.tiles.size();
  const std::size_t best = selection_->points();
  const State verdict = selection_->consider(region_.plane, region_.points);
  // A surface that is no ground may have been put together from parts of one that is.
  if (verdict != State::kFound && seeds_ == Seeds::kPromising) return;
  for (const std::size_t tile : region_.tiles) take(tile);
  if (selection_->points() > best) ground_ = ground_tiles_.ground();
}

void GridSearch::joinPieces(float level) {
  if (ground_tiles_.pieces().empty()) return;
  for (const std::size_t tile : ground_tiles_.pieces()) {
    region_.tiles.push_back(tile);
    region_.member[tile] = 1;
  }
  region_.points += ground_tiles_.piecePoints();
  const std::optional<RefinedPlane> joint = fitPlane(judge_, region_, region_.plane, level);
  if (!joint) return;
  region_.plane = joint->plane;
  judge_.setPlane(region_.plane, tiles_->centre(region_.tiles.front()), level);
  ground_tiles_.collect(judge_, region_.plane, region_.tiles, taken_, piece_limits_);
}

/// The largest part of a region that hangs together on the judge's plane.
void GridSearch::collectLargest(const TileRegion& grown) {
  region_.tiles.clear();
  region_.points = 0;
  std::size_t left = grown.points;
  seen_ = taken_;
  for (const std::size_t tile : grown.tiles) {
    if (left <= region_.points) return;
    judge_.judgeRows(static_cast<int>(tile) / tiles_->columns,
                     static_cast<int>(tile) / tiles_->columns);
    if (seen_[tile]) continue;
    if (!judge_.onPlane(tile)) {
      left -= static_cast<std::size_t>(tiles_->count[tile]);
      continue;
    }
    left -= std::min(left, collectPart(tile));
  }
}

/// Keeps what hangs together with a tile on the judge's plane if it is the largest so far.
/// @return [px] its points.
std::size_t GridSearch::collectPart(std::size_t tile) {
  const TileRegion& part = collect_.collect(judge_, tile, seen_);
  for (const std::size_t t : part.tiles) seen_[t] = 1;
  if (part.points > region_.points) region_ = part;
  return part.points;
}

}  // namespace dominant_plane_detection
