#pragma once

#include <cstdint>

#include "synthetic/scene.h"

namespace dominant_plane_detection {

struct Rendering;

/// What a scene without ground shows.
enum class GroundlessKind : std::uint8_t {
  kCeiling,     ///< a ceiling with lamps, the camera rolled by up to 60 degrees
  kUpsideDown,  ///< a floor with boxes, the camera on its head
  kWall,        ///< a wall with flat things on it
  kCorner,      ///< two walls, in every second scene with the ceiling
  kSteepTable,  ///< a table top tilted by 76 to 90 degrees, before a wall or nothing
  kPeople,      ///< figures of ellipsoids and cylinders, their feet out of sight
  kSpheres,     ///< balls before a wall or nothing
  kCurtain,     ///< a sheet that hangs in folds
};
constexpr std::uint32_t kGroundlessKinds = 8;

/// @return what `groundlessScene(seed)` shows: all kinds in turn.
GroundlessKind groundlessKind(std::uint32_t seed);

/// A scene that has no ground for a camera whose expected up is (0, -1, 0) of the optical frame: of
/// the pixels between 0.5 and 4 m, which are at least a tenth of the image, no surface within 75
/// degrees of up holds 5 % (`largestGroundShare`). What breaks this is drawn again. The path has
/// one key pose; `Rendering::normal` and `distance` mean nothing here.
/// @param seed the same scene for the same seed.
Scene groundlessScene(std::uint32_t seed);

/// The largest share of the pixels between 0.5 and 4 m whose exact surface normals lie within 10
/// degrees of one direction that is itself within 75 degrees of (0, -1, 0): at least that of the
/// largest plane that could be taken for ground.
/// @param rendering with surface normals.
/// @return [-] NaN where no pixel lies in the range.
double largestGroundShare(const Rendering& rendering);

}  // namespace dominant_plane_detection
