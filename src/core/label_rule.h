#pragma once

#include <cstdint>

namespace dominant_plane_detection {

/// What a tile of pixels shows.
enum TileKind : std::uint8_t {
  kElsewhere = 0,  ///< not the plane's region: within the band pixels are unknown
  kNearGround,     ///< the plane's region or next to it: within the band pixels are ground
  kSmeared,  ///< the same, at the foot of what is beyond the band: ground within the narrow band
  kAbove,    ///< a surface above the plane: what is above the plane is obstacle
  kBelow,    ///< a surface below the plane: what is below the plane is drop-off
};

/// [-] Of the narrow band: what is as near to the plane is no obstacle and no drop-off.
constexpr float kOnPlane = 0.6F;

/// A plane and the bands about it: |normal . r + distance| <= band + band_z2 z^2.
struct LabelRule {
  float normal[3];         ///< [-]
  float distance;          ///< [m]
  float band;              ///< [m]
  float band_z2;           ///< [1/m]
  float narrow = 0.0F;     ///< [m]
  float narrow_z2 = 0.0F;  ///< [1/m]

  /// @return [m] the narrow band at a depth [m].
  float narrowBand(float z) const { return narrow + narrow_z2 * z * z; }
};

}  // namespace dominant_plane_detection
