#pragma once

#include <cstdint>

#include "synthetic/scene.h"

namespace dominant_plane_detection {

/// A room with things on its floor, seen by a camera 0.3 to 1.5 m up, pitched down by 10 to 50
/// degrees and rolled by up to 15 degrees: walls 2.5 to 6 m away, two to eight boxes and cylinders
/// of 0.05 to 0.8 m, and in every third scene a low box across the whole view that cuts the floor
/// in two. The path has one key pose. At least 8 % of the image is floor between 0.5 and 4 m; what
/// has less is drawn again.
/// @param seed the same scene for the same seed.
Scene randomScene(std::uint32_t seed);

}  // namespace dominant_plane_detection
