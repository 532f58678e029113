#pragma once

#include <cstddef>

#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// On which side of near things there is no reading.
///
/// A structured-light or stereo camera cannot measure what its projector does not light, or its
/// second camera does not see. Both stand to the right of the depth camera (Kinect, Xtion,
/// RealSense D4xx), so that along a row from left to right it is: far, no reading, near. In a
/// mirrored image it is near, no reading, far. The gap is f b (1 / z_near - 1 / z_far) pixels wide,
/// which tells it from gaps of other causes.
struct ShadowSides {
  std::size_t left = 0;   ///< [#] rows' gaps to the left of something near, as they should be
  std::size_t right = 0;  ///< [#] to the right

  void add(const ShadowSides& other) {
    left += other.left;
    right += other.right;
  }
};

/// @param depth every second row is looked at.
ShadowSides shadowSides(const DepthView& depth, const CameraModel& camera);

}  // namespace dominant_plane_detection
