#pragma once

#include <optional>
#include <vector>

namespace dominant_plane_detection {

/// @param images, others [s] stamps, in any order.
/// @return [s] from an image to the nearest of others, > 0 where that is later; of images that have
/// none of the very same stamp the least. Nothing where there are none.
std::optional<double> stampOffset(const std::vector<double>& images, std::vector<double> others);

}  // namespace dominant_plane_detection
