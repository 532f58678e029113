#include "core/tile_judge.h"

#include <algorithm>

namespace dominant_plane_detection {

void TileJudge::start(const TileMoments& tiles, const TileLimits& limits) {
  tiles_ = &tiles;
  limits_ = &limits;
  verdicts_.resize(tiles.count.size());
  judged_.assign(static_cast<std::size_t>(tiles.rows), 0);
}

void TileJudge::setPlane(const HessePlane& plane, const Eigen::Vector3d& centre, float level) {
  test_ = {PlaneFrame::of(plane, centre), level};
  std::fill(judged_.begin(), judged_.end(), std::uint8_t{0});
}

void TileJudge::judgeRows(int first, int last) {
  const auto columns = static_cast<std::size_t>(tiles_->columns);
  const auto end = static_cast<std::size_t>(std::min(last + 1, tiles_->rows));
  for (auto row = static_cast<std::size_t>(std::max(first, 0)); row < end; ++row) {
    if (judged_[row]) continue;
    judged_[row] = 1;
    runTilePlaneKernel(*tiles_, *limits_, test_, row * columns, (row + 1) * columns, verdicts_);
  }
}

}  // namespace dominant_plane_detection
