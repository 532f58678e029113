#pragma once

#include <cstddef>
#include <vector>

#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// The raw disparity of a flat wall in the middle of many images. The disparity of a plane is an
/// affine function of the pixel, tilted or not: one is fitted to a window around the image's
/// middle, and its value there is what belongs to the wall's distance along the optical axis.
class WallReading {
 public:
  /// @param raw 16-bit image of raw disparity; 2047 and more is no reading.
  void add(const DepthView& raw);

  std::size_t images() const { return values_.size(); }

  /// @return [-] mean over all images.
  /// @throw std::runtime_error that says what is wrong: no image, a window without readings, no
  /// flat wall, or a camera that moved.
  double mean() const;

 private:
  std::vector<double> values_;  ///< [-] in the middle of each image that has readings there
  std::vector<double> bumps_;   ///< [-] how far each image is from the fitted plane
  std::size_t empty_ = 0;       ///< [#] images without readings in the middle
};

}  // namespace dominant_plane_detection
