#pragma once

#include <Eigen/Core>
#include <vector>

#include "dominant_plane_detection/camera_model.h"

namespace dominant_plane_detection {

/// @return [-] (X/Z, Y/Z) of every pixel, row-major; NaN where the lens distortion cannot be
/// inverted. By OpenCV and not by the core, so that an error in the core's rays shows in what it
/// makes of a rendered image.
std::vector<Eigen::Vector2f> cameraRays(const CameraModel& camera);

}  // namespace dominant_plane_detection
