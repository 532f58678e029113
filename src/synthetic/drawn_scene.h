#pragma once

#include "synthetic/scene.h"

namespace dominant_plane_detection {

// What scenes that are drawn at random have in common.

/// Puts an object somewhere, turned about the vertical.
/// @param position [m] @param yaw [rad]
SceneObject& place(Scene& scene, TriangleMesh mesh, const Eigen::Vector3d& position, double yaw);

/// @return whether at least 8 % of the image from the first key pose is floor between 0.5 and 4 m.
bool showsEnoughFloor(const Scene& scene);

}  // namespace dominant_plane_detection
