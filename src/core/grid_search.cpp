#include "core/plane_search.h"

namespace dominant_plane_detection {

std::size_t GridSearch::run(const TileMoments& tiles, const Parameters& parameters,
                            PlaneSelection& selection) {
  const std::size_t tried = search(tiles, parameters, Seeds::kPromising, selection);
  if (selection.found() || tried == 0) return tried;
  // Walls may have taken all the seeds; and to say why there is no ground, the planes that are none
  // have to be looked at.
  return search(tiles, parameters, Seeds::kAll, selection);
}

std::size_t GridSearch::search(const TileMoments& tiles, const Parameters& parameters, Seeds seeds,
                               PlaneSelection& selection) {
  growing_.start(tiles, growthThresholds(parameters));
  draw_.restart(static_cast<std::uint32_t>(parameters.random_seed));
  const auto columns = static_cast<std::size_t>(tiles.columns);
  const std::size_t lower_half = static_cast<std::size_t>(tiles.rows / 2) * columns;
  std::size_t tried = 0;
  const auto search_range = [&](std::size_t begin, std::size_t end) {
    draw_.setRange(begin, end);
    const std::size_t limit = tried + static_cast<std::size_t>(parameters.seeds);
    while (tried < limit && !draw_.empty() && growing_.availablePoints() > selection.points()) {
      const std::size_t seed = draw_.draw();
      if (!growing_.available(seed)) continue;
      ++tried;
      const auto first_plane = growing_.startRegion(seed);
      if (!first_plane) continue;
      if (seeds == Seeds::kPromising && selection.clearlyTooTilted(*first_plane)) {
        growing_.claimStart();
        continue;
      }
      // What is far from being the largest even now will not become so.
      const auto refined = growing_.refine(growing_.grow().plane, selection.toBeat() / 2);
      if (refined) selection.consider(refined->plane, refined->points);
    }
  };
  search_range(lower_half, tiles.size());
  if (!selection.found()) search_range(0, lower_half);
  return tried;
}

}  // namespace dominant_plane_detection
