#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/tile_moments.h"

namespace dominant_plane_detection {

/// A plane as a point on it and three axes, the last of them its normal.
struct PlaneFrame {
  Eigen::Vector3f origin;  ///< [m]
  Eigen::Matrix3f axes;    ///< [-] orthonormal columns a, b, n
};

/// What decides whether a tile lies on a plane: its mean and two standard deviations to either side
/// closer than gamma, and enough points.
struct TileRule {
  float min_count;                   ///< [#]
  const std::vector<float>& gamma;   ///< [m] of each tile, padded like the moments
  const std::vector<float>& weight;  ///< [1/m^2] of each of the tile's points
};

/// Weighted sums over the points of the tiles on a plane, in the coordinates (alpha, beta, h) of
/// its frame: the normal equations of h = p alpha + q beta + c.
struct PlaneResiduals {
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  std::size_t points = 0;  ///< [px] not weighted
};

/// Looks at all tiles, with the widest vector instructions that this machine has.
///
/// Heights over a plane nearby are small numbers, so float is enough for their sums. The extent of
/// single tiles is left out of `normal_matrix`, which only steers the steps, not of `right`, which
/// is zero at the solution.
/// @param on_plane 1 for each tile on the plane, 0 for the others; of the padded size.
PlaneResiduals runPlaneRefinementKernel(const TileMoments& tiles, const TileRule& rule,
                                        const PlaneFrame& frame,
                                        std::vector<std::uint8_t>& on_plane);

}  // namespace dominant_plane_detection
