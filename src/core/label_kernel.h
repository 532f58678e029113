#pragma once

#include <cstddef>
#include <cstdint>

#include "core/image_kernel.h"

namespace dominant_plane_detection {

/// A plane and the band about it that is ground: |normal . r + distance| <= band + band_z2 z^2.
struct LabelRule {
  float normal[3];  ///< [-]
  float distance;   ///< [m]
  float band;       ///< [m]
  float band_z2;    ///< [1/m]
};

/// What the kernel counted.
struct LabelSums {
  std::size_t ground = 0;      ///< [px]
  double square_height = 0.0;  ///< [m^2] summed over these
};

/// Writes the label of every pixel, row-major.
/// @param near_ground 1 for each tile, row-major, whose pixels within the band are ground;
/// elsewhere they are unknown.
LabelSums runLabelKernel(const ImageInput& input, const LabelRule& rule,
                         const std::uint8_t* near_ground, std::uint8_t* labels);

}  // namespace dominant_plane_detection
