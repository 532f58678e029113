#pragma once

#include <cstddef>
#include <cstdint>

#include "core/image_kernel.h"

namespace dominant_plane_detection {

/// What a tile of pixels shows.
enum TileKind : std::uint8_t {
  kElsewhere = 0,  ///< not the plane's region: within the band pixels are unknown
  kNearGround,     ///< the plane's region or next to it: within the band pixels are ground
  kSmeared,        ///< the same, next to what blurs it: ground within the narrow band, else unknown
};

/// A plane and the bands about it: |normal . r + distance| <= band + band_z2 z^2.
struct LabelRule {
  float normal[3];         ///< [-]
  float distance;          ///< [m]
  float band;              ///< [m]
  float band_z2;           ///< [1/m]
  float narrow = 0.0F;     ///< [m]
  float narrow_z2 = 0.0F;  ///< [1/m]
};

/// What the kernel counted.
struct LabelSums {
  std::size_t ground = 0;      ///< [px]
  double square_height = 0.0;  ///< [m^2] summed over these
};

/// Writes the label of every pixel, row-major.
/// @param tiles the `TileKind` of each tile, row-major.
LabelSums runLabelKernel(const ImageInput& input, const LabelRule& rule, const std::uint8_t* tiles,
                         std::uint8_t* labels);

}  // namespace dominant_plane_detection
