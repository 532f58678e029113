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
  collect_.start(image.tiles, tileAngle(image.camera));
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
  join_pieces_ = parameters.join_pieces;
  min_piece_ = image.min_piece;
  limits_.set(*tiles_, growthThresholds(parameters));
  judge_.start(*tiles_, limits_);
  pieces_.start(*tiles_, tileAngle(image.camera));
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
  region_.tiles.clear();
  const auto& pieces = pieces_.join(judge_, plane, min_piece_, taken_, region_.tiles);
  if (join_pieces_ || pieces.empty()) return markGround(0, region_.tiles.size());
  const auto largest =
      std::max_element(pieces.begin(), pieces.end(),
                       [](const auto& a, const auto& b) { return a.points < b.points; });
  markGround(largest->begin, largest->end);
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
  if (join_pieces_) joinPieces();
  effort_->joined += region_.tiles.size();
  const std::size_t best = selection_->points();
  const State verdict = selection_->consider(region_.plane, region_.points);
  // A surface that is no ground may have been put together from parts of one that is.
  if (verdict != State::kFound && seeds_ == Seeds::kPromising) return;
  for (const std::size_t tile : region_.tiles) take(tile);
  if (selection_->points() > best) markGround(0, region_.tiles.size());
}

void GridSearch::joinPieces() {
  seen_ = taken_;
  for (const std::size_t tile : region_.tiles) seen_[tile] = 1;
  for (const auto& piece : pieces_.join(judge_, region_.plane, min_piece_, seen_, region_.tiles)) {
    region_.points += piece.points;
  }
}

void GridSearch::markGround(std::size_t begin, std::size_t end) {
  ground_.assign(tiles_->count.size(), 0);
  for (std::size_t i = begin; i < end; ++i) ground_[region_.tiles[i]] = 1;
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
    const TileRegion& part = collect_.collect(judge_, tile, seen_);
    for (const std::size_t t : part.tiles) seen_[t] = 1;
    left -= std::min(left, part.points);
    if (part.points > region_.points) region_ = part;
  }
}

}  // namespace dominant_plane_detection
