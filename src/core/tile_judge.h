#pragma once

#include <cstdint>
#include <vector>

#include "core/tile_plane_kernel.h"

namespace dominant_plane_detection {

/// Holds the tiles of an image against one plane after another; a row of tiles is judged when it is
/// first looked at, so that a small region costs little.
class TileJudge {
 public:
  /// @param tiles, limits have to outlive the calls below, and stay as they are.
  void start(const TileMoments& tiles, const TileLimits& limits);

  /// @param centre [m] a point near the tiles that matter, see `PlaneFrame`.
  void setPlane(const HessePlane& plane, const Eigen::Vector3d& centre,
                float level = std::numeric_limits<float>::infinity());
  /// The rows [first, last], as far as the image has them.
  void judgeRows(int first, int last);
  void judgeAll() { judgeRows(0, tiles_->rows - 1); }

  /// @pre the tile's row was judged.
  TileVerdict verdict(std::size_t tile) const { return verdicts_.verdict[tile]; }
  const TileVerdict* verdicts() const { return verdicts_.verdict.data(); }
  bool onPlane(std::size_t tile) const { return verdict(tile) == TileVerdict::kOnPlane; }
  /// @return [m] mean height over the plane; negative on the camera's side.
  float height(std::size_t tile) const { return verdicts_.height[tile]; }
  /// @return [m^2] of the heights of the tile's points.
  float meanSquare(std::size_t tile) const { return verdicts_.mean_square[tile]; }

  const TileMoments& tiles() const { return *tiles_; }
  const TileLimits& limits() const { return *limits_; }
  const PlaneTest& test() const { return test_; }

 private:
  const TileMoments* tiles_ = nullptr;
  const TileLimits* limits_ = nullptr;
  PlaneTest test_;
  TileVerdicts verdicts_;
  std::vector<std::uint8_t> judged_;  ///< 1 for each row that was
};

}  // namespace dominant_plane_detection
