#include "core/grid_search.h"

#include <algorithm>

namespace dominant_plane_detection {

void GridSearch::run(const TileMoments& tiles, double tile_angle, std::size_t min_piece,
                     const Parameters& parameters, PlaneSelection& selection, Effort& effort) {
  effort_ = &effort;
  start(tiles, tile_angle, min_piece, parameters);
  growth_.start(tiles, tile_angle);
  collect_.start(tiles, tile_angle);
  search(parameters, Seeds::kPromising, selection);
  if (selection.found() || effort.seeds == 0) return;
  // Walls may have taken all the seeds; and to say why there is no ground, the planes that are none
  // have to be looked at.
  search(parameters, Seeds::kAll, selection);
}

void GridSearch::start(const TileMoments& tiles, double tile_angle, std::size_t min_piece,
                       const Parameters& parameters) {
  tiles_ = &tiles;
  join_pieces_ = parameters.join_pieces;
  min_piece_ = min_piece;
  limits_.set(tiles, growthThresholds(parameters));
  judge_.start(tiles, limits_);
  pieces_.start(tiles, tile_angle);
  taken_.assign(tiles.count.size(), 0);
}

void GridSearch::collectGround(const TileMoments& tiles, double tile_angle, std::size_t min_piece,
                               const Parameters& parameters, const HessePlane& plane) {
  start(tiles, tile_angle, min_piece, parameters);
  judge_.setPlane(plane, plane.distance * plane.normal);
  region_.tiles.clear();
  const auto& pieces = pieces_.join(judge_, plane, min_piece, taken_, region_.tiles);
  if (join_pieces_ || pieces.empty()) return markGround(0, region_.tiles.size());
  const auto largest =
      std::max_element(pieces.begin(), pieces.end(),
                       [](const auto& a, const auto& b) { return a.points < b.points; });
  markGround(largest->begin, largest->end);
}

void GridSearch::search(const Parameters& parameters, Seeds seeds, PlaneSelection& selection) {
  taken_.assign(tiles_->count.size(), 0);
  seeded_.assign(tiles_->count.size(), 0);
  available_points_ = 0;
  for (std::size_t tile = 0; tile < tiles_->size(); ++tile) {
    if (available(tile)) available_points_ += static_cast<std::size_t>(tiles_->count[tile]);
  }
  draw_.restart(static_cast<std::uint32_t>(parameters.random_seed));
  const auto columns = static_cast<std::size_t>(tiles_->columns);
  const std::size_t lower_half = static_cast<std::size_t>(tiles_->rows / 2) * columns;
  const std::size_t limit = effort_->seeds + static_cast<std::size_t>(parameters.seeds);
  const auto search_range = [&](std::size_t begin, std::size_t end) {
    draw_.setRange(begin, end);
    while (effort_->seeds < limit && !draw_.empty() && available_points_ > selection.points()) {
      const std::size_t seed = draw_.draw();
      if (!available(seed)) continue;
      ++effort_->seeds;
      tryRegion(seed, seeds, selection);
    }
  };
  search_range(lower_half, tiles_->size());
  search_range(0, lower_half);
}

void GridSearch::take(std::size_t tile) {
  if (taken_[tile]) return;
  taken_[tile] = 1;
  available_points_ -= static_cast<std::size_t>(tiles_->count[tile]);
}

void GridSearch::tryRegion(std::size_t tile, Seeds seeds, PlaneSelection& selection) {
  seeded_[tile] = 1;
  const std::optional<TileSeed> seed = fitSeed(judge_, taken_, tile);
  ++effort_->fits;
  if (!seed) return;
  if (seeds == Seeds::kPromising && selection.clearlyTooTilted(seed->fit.plane)) {
    std::for_each_n(seed->tiles.begin(), seed->count, [&](std::size_t t) { take(t); });
    return;
  }
  const TileRegion& grown = growth_.grow(judge_, *seed, taken_);
  ++effort_->regions;
  effort_->joined += grown.tiles.size();
  effort_->fits += growth_.fits();
  if (grown.points < selection.toBeat() / 2) {
    // What is far from being the largest even now will not become so.
    selection.consider(grown.plane, grown.points);
    return;
  }
  finishRegion(grown, selection);
}

/// Fits the plane to the one surface in what was grown, and decides again what belongs to it.
void GridSearch::finishRegion(const TileRegion& grown, PlaneSelection& selection) {
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
  for (const std::size_t tile : region_.tiles) take(tile);
  if (join_pieces_) {
    for (const auto& piece :
         pieces_.join(judge_, region_.plane, min_piece_, taken_, region_.tiles)) {
      region_.points += piece.points;
      available_points_ -= piece.points;
    }
  }
  effort_->joined += region_.tiles.size();
  if (selection.consider(region_.plane, region_.points)) markGround(0, region_.tiles.size());
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
