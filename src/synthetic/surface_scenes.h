#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "synthetic/renderer.h"
#include "synthetic/scene.h"

namespace dominant_plane_detection {

/// What a floor has that a plane could be bent by.
enum class FloorKind : std::uint8_t {
  kClean,
  kCluttered,
  kCut,           ///< in two, by a low wall across the view
  kKerb,          ///< a pavement on one side, 30 to 150 mm high
  kPlate,         ///< of 10 to 40 mm on it
  kSill,          ///< of a door across the view, 10 to 40 mm high
  kRampUp,        ///< of 2 to 8 degrees, with the floor on its sides
  kRampDown,      ///< the same, across the view
  kStepDown,      ///< 30 to 200 mm across the view
  kStairs,        ///< three to five steps, up or down
  kTwoLevels,     ///< the farther 20 to 150 mm higher
  kTable,         ///< in the foreground
  kLowObstacles,  ///< boxes and cylinders of 10 to 50 mm
  kRolled,        ///< a camera rolled by 30 degrees
};

inline constexpr std::array kFloorKinds = {
    FloorKind::kClean,        FloorKind::kCluttered, FloorKind::kCut,       FloorKind::kKerb,
    FloorKind::kPlate,        FloorKind::kSill,      FloorKind::kRampUp,    FloorKind::kRampDown,
    FloorKind::kStepDown,     FloorKind::kStairs,    FloorKind::kTwoLevels, FloorKind::kTable,
    FloorKind::kLowObstacles, FloorKind::kRolled};

/// @return the kind in words, for example "ramp down".
const char* floorKindName(FloorKind kind);

/// A plane: normal . r = offset.
struct Surface {
  Eigen::Vector3d normal;  ///< [-] unit, upwards
  double offset;           ///< [m]
};

/// A scene with all its surfaces that one could take for the ground, the floor z = 0 first.
struct SurfaceScene {
  Scene scene;
  std::vector<Surface> surfaces;  ///< in the world
};

/// Draws a scene of a kind: a camera 0.4 to 2 m up that looks at a place 1 to 2.5 m ahead, rolled
/// by up to 10 degrees (kRolled: 30), and upright within 55 degrees. At least 15 % of the image is
/// floor between 0.5 and 4 m, and 2 % another surface where the kind has one; what shows less is
/// drawn again.
/// @param seed the same scene for the same kind and seed.
SurfaceScene surfaceScene(FloorKind kind, std::uint32_t seed);

/// @return the surface each pixel of the scene's first key pose shows, row-major; -1 for none.
std::vector<int> shownSurfaces(const SurfaceScene& scene, const Rendering& rendering);

}  // namespace dominant_plane_detection
