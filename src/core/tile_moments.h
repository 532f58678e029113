#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// [px] side of the square tiles: eight floats are one AVX register, and 8 x 8 readings average the
/// noise of one by eight while a tile at 4 m is still only 6 cm wide.
constexpr int kTileSize = 8;

/// @return [rad] that a tile's side subtends in the middle of the image.
inline double tileAngle(const CameraModel& camera) {
  return kTileSize / std::max(camera.fx, camera.fy);
}

/// Moments of the points in each image tile, row-major, one flat array per number, filled up with
/// zeros to whole vectors and one more, so that a row can be read in whole vectors as well. Tiles
/// at the right and lower border may be partly outside the image.
struct TileMoments {
  int columns = 0;                            ///< [#]
  int rows = 0;                               ///< [#]
  std::vector<float> count;                   ///< [#] points; the other numbers are 0 where it is 0
  std::vector<float> x, y, z;                 ///< [m] centre r_g
  std::vector<float> xx, xy, xz, yy, yz, zz;  ///< [m^2] scatter A / count

  /// @return [#] of tiles, without the padding of the arrays.
  std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  Eigen::Vector3d centre(std::size_t tile) const { return {x[tile], y[tile], z[tile]}; }
  /// @return [m^2] A, the sum over the tile's points (Eq. 5).
  Eigen::Matrix3d scatter(std::size_t tile) const {
    Eigen::Matrix3d a;
    a << xx[tile], xy[tile], xz[tile],  //
        xy[tile], yy[tile], yz[tile],   //
        xz[tile], yz[tile], zz[tile];
    return a * static_cast<double>(count[tile]);
  }

  void resize(int image_width, int image_height);
};

/// Reads the whole image once.
/// @param rays of a camera with the size of the image.
/// @param range_min [m] readings outside [range_min, range_max], NaN among them, do not count.
/// @param range_max [m]
/// @param tiles resized to the image and overwritten.
void computeTileMoments(const DepthView& depth, const RayTable& rays, float range_min,
                        float range_max, TileMoments& tiles);

}  // namespace dominant_plane_detection
