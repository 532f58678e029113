#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/hesse_plane.h"
#include "core/tile_moments.h"
#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// The sizes of a depth camera's errors.
struct ErrorSizes {
  NoiseModel noise;     ///< sigma(z), by which fits weigh
  NoiseModel smooth;    ///< [m] rms of large parts of a floor over its plane
  WideErrorModel wide;  ///< [m] rms of what large parts share with the plane
};

inline ErrorSizes errorSizes(const Parameters& parameters) {
  return {parameters.noise, parameters.smooth_error, parameters.wide_error};
}

/// How sure a fitted plane is, under errors that neighbouring readings share.
///
/// Counting readings would promise micrometres. But a depth camera's error is smooth: short waves
/// of some tens of pixels, whose size the image itself shows in the differences between adjacent
/// cells, and waves as wide as a plane, that no fit can tell from the plane and only the sensor's
/// profile knows. With the fit's weights W, Jacobian J and H = J^T W J the plane's covariance is
/// H^-1 J^T W E W J H^-1; in the errors' covariance E each kind of wave has a size at each reading,
/// and a correlation that falls with the distance in the image.
class PlaneCovariance {
 public:
  /// @param plane fitted to the tiles by weights 1 / sigma(z)^2.
  /// @param ground 1 for the plane's tiles, padded like the moments; those whose means are off it
  /// by more than three sigma(z) do not count.
  /// @param image_width [px]
  /// @return of [normal, distance] as `Detection` has them, of rank 3; unknown if the tiles do not
  /// determine a plane, or the camera is in it.
  Eigen::Matrix4d estimate(const TileMoments& tiles, const std::vector<std::uint8_t>& ground,
                           const HessePlane& plane, const ErrorSizes& sizes, int image_width);

 private:
  /// A square of tiles.
  struct Cell {
    double points = 0.0;                                 ///< [px]
    Eigen::Vector4d sums = Eigen::Vector4d::Zero();      ///< weights, times x, y, z and 1
    Eigen::Vector3d jacobian = Eigen::Vector3d::Zero();  ///< J^T W of the cell
    double height = 0.0;                                 ///< [m] mean over the plane
    double smooth = 0.0;                                 ///< [m] size of the short waves
    double wide = 0.0;                                   ///< [m] size of the wide ones
  };
  /// Correlations between columns of cells, and between rows of them.
  struct Correlations {
    Eigen::MatrixXd columns, rows;
  };

  void resize(const TileMoments& tiles, int image_width);
  Eigen::Matrix4d addTiles(const TileMoments& tiles, const std::vector<std::uint8_t>& ground,
                           const HessePlane& plane, const NoiseModel& noise);
  double shortWaves() const;
  Eigen::Matrix3d spread(double Cell::*size, const Correlations& correlations);

  int image_width_ = 0;  ///< [px]
  int side_ = 0;         ///< [#] tiles along a cell
  int columns_ = 0, rows_ = 0;
  std::vector<Cell> cells_;  ///< row-major
  Correlations short_, wide_;
  double neighbours_ = 0.0;  ///< [-] correlation of adjacent cells by short waves
  Eigen::MatrixXd values_, along_rows_, near_;  ///< what is kept for its memory
};

}  // namespace dominant_plane_detection
