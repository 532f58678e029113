#pragma once

#include "core/ray_table.h"
#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// @return how many squares with a side of so many pixels cover a length.
constexpr int covering(int length, int side) { return (length + side - 1) / side; }

/// Which readings count, and what they mean.
struct ReadingRange {
  float metres_per_unit;  ///< [m]
  float min;              ///< [m]
  float max;              ///< [m]
};

/// What every loop over the pixels reads.
struct ImageInput {
  const DepthView& depth;
  const RayTable& rays;
  ReadingRange range;
};

}  // namespace dominant_plane_detection
