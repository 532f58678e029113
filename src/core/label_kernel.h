#pragma once

#include <cstddef>
#include <cstdint>

#include "core/block_heights.h"
#include "core/image_kernel.h"
#include "core/label_rule.h"

namespace dominant_plane_detection {

/// What the kernel counted.
struct LabelSums {
  std::size_t ground = 0;      ///< [px]
  double square_height = 0.0;  ///< [m^2] summed over these
};

/// Writes the label of every pixel, row-major, and sums heights in blocks, in one look at the
/// image. A reading beyond the range is a drop-off where it is below twice the band and the plane
/// should have been seen within the range.
/// @param tiles the `TileKind` of each tile, row-major; none is kSmeared yet.
/// @param blocks resized to the image and overwritten; not looked at if null.
LabelSums runLabelKernel(const ImageInput& input, const LabelRule& rule, const std::uint8_t* tiles,
                         std::uint8_t* labels, BlockHeights* blocks);

/// Labels the pixels of the tiles that are kSmeared again, which were kNearGround.
/// @return what is ground no more.
LabelSums labelSmeared(const ImageInput& input, const LabelRule& rule, const std::uint8_t* tiles,
                       std::uint8_t* labels);

}  // namespace dominant_plane_detection
