#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {

/// The convex hull of the ground that is seen, on the plane itself; without ramps.
/// @param rays of the detection's camera.
/// @return [m] corners in the optical frame; empty without a plane, or with too little ground for a
/// hull.
std::vector<Eigen::Vector3d> groundOutline(const Detection& detection, const RayTable& rays);

/// The same of the further planes, by their pixels in `Detection::plane_index`.
/// @return one outline for each of them.
std::vector<std::vector<Eigen::Vector3d>> furtherOutlines(const Detection& detection,
                                                          const RayTable& rays);

}  // namespace dominant_plane_detection
