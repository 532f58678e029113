#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/hesse_plane.h"
#include "core/image_kernel.h"
#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {

/// What a plane has of an image.
struct PlaneShare {
  std::size_t points = 0;          ///< [px]
  double mean_square_error = 0.0;  ///< [m^2] of their heights, Eq. 8; 0 if there are none
};

/// Numbers the pixels of a plane's tiles that are within a band of it and have no number yet.
/// @param tiles 1 for these, row-major.
/// @param band [m] of a pixel's depth.
/// @param number of the plane.
/// @param index one number a pixel, 0 for none, row-major.
PlaneShare numberPixels(const ImageInput& input, const HessePlane& plane,
                        const std::vector<std::uint8_t>& tiles, const DepthThreshold& band,
                        const NoiseModel& noise, std::uint8_t number,
                        std::vector<std::uint8_t>& index);

}  // namespace dominant_plane_detection
