#pragma once

#include "synthetic/scene.h"

namespace dominant_plane_detection {

/// Scenes of one difficulty each: a floor (z = 0, the true ground), what lies on it or breaks it,
/// and a camera at the origin that looks along x. The path has one key pose.

/// A square plate of 0.8 m on the floor, before a camera 0.6 m up.
/// @param height [m] of the plate's top, > 0.
/// @param ahead [m] from the camera to its near edge.
Scene plateScene(double height, double ahead);

/// A road and, left of a line along it, a pavement; camera 0.6 m up.
/// @param height [m] of the pavement over the road, > 0.
/// @param aside [m] from the camera to the kerb, > 0.
Scene kerbScene(double height, double aside);

/// A ramp of 1.2 m width and length, rising away from a camera 0.6 m up, with the floor on its
/// sides.
/// @param slope [rad] > 0
/// @param ahead [m] from the camera to its foot.
Scene rampScene(double slope, double ahead);

/// A floor that goes on higher or lower beyond a step across the whole view; camera 0.8 m up. The
/// near floor is the true ground.
/// @param step [m] > 0: the far floor is higher, < 0: lower.
/// @param ahead [m] from the camera to the step.
Scene twoLevelScene(double step, double ahead);

/// An open door of 0.9 m in a wall across the view, with a sill of 0.1 m depth; the floor goes on
/// behind it. Camera 0.6 m up.
/// @param height [m] of the sill, > 0.
/// @param ahead [m] from the camera to the wall.
Scene doorSillScene(double height, double ahead);

/// A table of 1.6 m x 0.8 m on four legs, long side across, before a camera 0.5 m above its top.
/// @param height [m] of the table's top, > 0.05.
/// @param ahead [m] from the camera to its near edge; the nearer, the more of the image it has.
Scene tableScene(double height, double ahead);

}  // namespace dominant_plane_detection
