#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/plane_frame.h"
#include "core/tile_limits.h"
#include "core/tile_moments.h"

namespace dominant_plane_detection {

/// A plane that tiles are held against, and how close they have to be.
///
/// A tile touches the plane if it has enough readings, if its mean height is closer than gamma, and
/// if its own normal agrees: the heights that go with the place within the tile, its slope, have a
/// standard deviation below kMaxSlope sigma(z). It lies on the plane if, beyond that, all its
/// points are closer than gamma, its mean height and two standard deviations to either side, and
/// its mean is closer than `level` sigma(z).
struct PlaneTest {
  PlaneFrame frame;
  float level = std::numeric_limits<float>::infinity();  ///< [-] in sigma(z)

  /// [-] The slope of floors in recordings stays below this in 97 to 99 % of the tiles at any
  /// depth; a wall's is 1.3 (1 m) to 0.9 (3 m) for a Kinect, more for wider lenses.
  static constexpr float kMaxSlope = 0.85F;
};

enum class TileVerdict : std::uint8_t { kOff = 0, kTouches, kOnPlane };

/// What the test said of each tile, padded like the moments.
struct TileVerdicts {
  std::vector<TileVerdict> verdict;
  std::vector<float> height;       ///< [m] mean; negative on the camera's side
  std::vector<float> mean_square;  ///< [m^2] of the heights of the tile's points

  void resize(std::size_t size) {
    verdict.resize(size);
    height.resize(size);
    mean_square.resize(size);
  }
};

/// Holds the tiles [begin, end) against a plane, with the widest vector instructions that this
/// machine has. Up to a tile's width of tiles behind `end` are judged as well.
void runTilePlaneKernel(const TileMoments& tiles, const TileLimits& limits, const PlaneTest& test,
                        std::size_t begin, std::size_t end, TileVerdicts& verdicts);

/// Weighted sums over the points of tiles on a plane, in the coordinates (alpha, beta, h) of its
/// frame: the normal equations of h = p alpha + q beta + c.
struct PlaneResiduals {
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  std::size_t points = 0;  ///< [px] not weighted
};

/// Sums over the tiles that are members of a region and lie on the plane. A point weighs
/// 1 / sigma(z)^2, times (1 + (h / (width sigma))^2)^-2 of its tile's mean height (Geman and
/// McClure, 1985), which turns the mean into a mode as `width` [-] becomes small; infinity: no more
/// than 1 / sigma^2.
///
/// The extent of single tiles is left out of `normal_matrix`, which only steers the steps, not of
/// `right`, which is zero at the solution.
/// @param members 1 for a member, of the padded size.
PlaneResiduals runResidualKernel(const TileMoments& tiles, const TileLimits& limits,
                                 const PlaneTest& test, float width,
                                 const std::vector<std::uint8_t>& members);

}  // namespace dominant_plane_detection
