#pragma once

#include <cstdint>

#include "synthetic/scene.h"

namespace dominant_plane_detection {

/// A room full of planes, seen by a camera 0.4 to 1.6 m up: walls 2 to 3.6 m away, and one to three
/// of a ramp of 6 to 20 degrees, a platform of 80 to 300 mm and a table of 0.5 to 0.9 m, turned as
/// they like. The path has one key pose. At least 8 % of the image is floor between 0.5 and 4 m;
/// what has less is drawn again.
/// @param seed the same scene for the same seed.
Scene roomScene(std::uint32_t seed);

}  // namespace dominant_plane_detection
