#pragma once

#include <vector>

#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// Takes away the part of a depth camera's error that is fixed to its pixels: 1 / z' = 1 / z - c of
/// the pixel, with c bilinear between the middles of image cells. For triangulating cameras c is an
/// error of disparity, and the error of depth grows with z^2.
///
/// What turns planes into planes, a part of c that is affine in the image, cannot be learned from
/// floors (`calibrate_floor`): it is such that on average the planes that c was learned from do not
/// move.
class DepthCorrection {
 public:
  struct Grid {
    int columns = 0;                    ///< [#] cells across the image
    int rows = 0;                       ///< [#]
    std::vector<double> inverse_depth;  ///< [1/m] c of each cell's middle, row-major
  };

  /// @throw std::invalid_argument for a grid without cells, or whose numbers are not finite, too
  /// many or too few, or of more than 0.1 / m, which no camera's error is.
  explicit DepthCorrection(const Grid& grid);

  /// @param depth of any size: the cells cover the image.
  /// @return the corrected image in metres, in memory of the correction that is valid until the
  /// next call. Without a reading where there was none; infinite where c says that 1 / z' <= 0. An
  /// image without pixels comes back as it is.
  DepthView correct(const DepthView& depth);

  const Grid& grid() const { return grid_; }

 private:
  void resize(int width, int height);

  Grid grid_;
  int width_ = 0, height_ = 0;  ///< [px]
  std::vector<float> table_;    ///< [1/m] c of each pixel
  std::vector<float> pixels_;   ///< [m]
};

}  // namespace dominant_plane_detection
