#pragma once

#include <algorithm>

#include "dominant_plane_detection/camera_model.h"

namespace dominant_plane_detection {

struct Pixel {
  int u, v;
};

/// The upright rectangle about pixels that hang together.
struct PixelOutline {
  int left, right, top, bottom;  ///< [px]

  explicit PixelOutline(Pixel pixel)
      : left(pixel.u), right(pixel.u), top(pixel.v), bottom(pixel.v) {}

  void add(Pixel pixel) {
    left = std::min(left, pixel.u);
    right = std::max(right, pixel.u);
    top = std::min(top, pixel.v);
    bottom = std::max(bottom, pixel.v);
  }
  /// @return [px] the larger one.
  int side() const { return std::max(right - left, bottom - top) + 1; }
  /// @return [m] that side at a depth [m].
  double width(double z, const CameraModel& camera) const {
    return side() * z / std::max(camera.fx, camera.fy);
  }
};

}  // namespace dominant_plane_detection
