#pragma once

#include <cstdint>
#include <vector>

#include "core/image_kernel.h"
#include "core/pixel_outline.h"

namespace dominant_plane_detection {

/// Finds drop-offs on the ground that are no larger than a bump of the sensor's error.
///
/// Far away the error reaches beyond the ground band now and then, and hangs together over some
/// pixels. A drop-off that matters is wider than the narrowest obstacle, and wider than a
/// fortieth of the image, 16 pixels of 640, where errors do not hang together any more; or the
/// image's border cuts it off.
class DropOffSpecks {
 public:
  /// @param tiles the `TileKind` of each tile: only kNearGround and kSmeared ones are looked at.
  /// @param min_width [m] the larger side of a drop-off's outline in the image.
  /// @param labels one `Label` a pixel; smaller drop-offs become unknown.
  void remove(const ImageInput& input, const std::vector<std::uint8_t>& tiles, double min_width,
              std::vector<std::uint8_t>& labels);

 private:
  void take(const ImageInput& input, Pixel pixel);
  bool isLarge(const ImageInput& input, const PixelOutline& outline, double min_width) const;
  bool grow(const ImageInput& input, Pixel start, double min_width,
            const std::vector<std::uint8_t>& labels);
  void settle(const ImageInput& input, Pixel start, double min_width,
              std::vector<std::uint8_t>& labels);

  std::vector<std::uint8_t> seen_;  ///< what is known of each pixel
  std::vector<Pixel> pixels_;       ///< of one piece
  float nearest_ = 0.0F;            ///< [m] of these
};

}  // namespace dominant_plane_detection
