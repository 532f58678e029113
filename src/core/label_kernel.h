#pragma once

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

/// Writes the label of every pixel, row-major.
/// @return [m^2] sum of the squared heights of the ground pixels.
double runLabelKernel(const ImageInput& input, const LabelRule& rule, std::uint8_t* labels);

}  // namespace dominant_plane_detection
