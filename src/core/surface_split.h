#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/tile_growth.h"
#include "core/tile_judge.h"

namespace dominant_plane_detection {

/// Tells two surfaces among tiles that are within gamma of one plane: a floor and the ramp that
/// begins on it, two levels that differ by less than the sensor's worst error. One plane through
/// both lies on neither.
///
/// Planes fitted to the near, middle and far, left and right parts of the tiles compete in pairs
/// for the heights of squares of two by two tiles. The best pair divides the squares between it,
/// each going where most of the 7 x 7 about it are nearer to, and is fitted again to its own, by
/// turns. Any two planes divide a sensor's error between them better than one does; but there are
/// two surfaces only where means over those 7 x 7 squares show that one plane is bent by more than
/// the sensor's smooth error, and two are not, or where two are straight by far.
class SurfaceSplit {
 public:
  /// @param judge of the tiles.
  /// @param region tiles near its plane, by which heights are meant.
  /// @param smooth_error [m] rms of the means of 7 x 7 squares of a floor over its plane.
  /// @pre the region has a tile.
  /// @return whether there are two surfaces, each with 5 % of the points at least.
  bool find(const TileJudge& judge, const TileRegion& region, const NoiseModel& smooth_error);

  /// @return the tiles of the two surfaces that `find` told, with their planes.
  const std::array<TileRegion, 2>& sides() const { return sides_; }

 private:
  /// A plane as heights over the region's plane: h = p a + q b + c.
  struct Sheet {
    float p = 0.0F, q = 0.0F, c = 0.0F;
  };
  using Numbers = Eigen::ArrayXf;
  using Pair = std::array<Sheet, 2>;
  /// The sums of a plane fit: weighted products of a, b and h.
  enum Product { kOne, kA, kB, kH, kAA, kAB, kBB, kAH, kBH, kProducts };

  void collect(const TileJudge& judge, const TileRegion& region, const NoiseModel& smooth_error);
  std::optional<Sheet> fit(const Numbers& chosen) const;
  void addBands(const Numbers& places, int count);
  std::optional<Pair> bestPair();
  void divide(const Pair& pair);
  bool refit(Pair& pair) const;
  std::array<float, 2> bendSums(const Pair& sheets, const Numbers& side);
  void takeSides(const TileJudge& judge, const TileRegion& region, const Pair& pair);
  Eigen::Index squareOf(std::size_t tile) const;
  /// @return [m] an expression.
  auto heightsOver(const Sheet& sheet) const { return h_ - sheet.p * a_ - sheet.q * b_ - sheet.c; }

  int columns_ = 0, rows_ = 0;    ///< [#] of squares
  std::size_t tile_columns_ = 0;  ///< [#]
  PlaneFrame frame_;
  /// Of each square, row-major: [px] points, [m] their mean in the frame of the region's plane and
  /// its depth, [1/m] 1 / sigma(z) and 1 / smooth error, and its place.
  Numbers points_, a_, b_, h_, depth_, inverse_sigma_, inverse_smooth_, column_, row_;
  Eigen::Matrix<float, Eigen::Dynamic, kProducts> products_;  ///< weights: points / sigma(z)^2
  Numbers first_, second_;  ///< 1 for the squares of either surface
  std::array<TileRegion, 2> sides_;

  // What is kept for its memory.
  std::vector<Sheet> bands_;
  std::vector<Numbers> supports_;
  std::vector<float> place_points_, column_sum_;
  Numbers chosen_, values_, window_points_, window_heights_;
};

}  // namespace dominant_plane_detection
