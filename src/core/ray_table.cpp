#include "core/ray_table.h"

namespace dominant_plane_detection {

void RayTable::build(const CameraModel& camera) {
  if (camera == camera_) return;
  camera_ = camera;
  const auto columns = static_cast<std::size_t>(camera.width);
  const auto rows = static_cast<std::size_t>(camera.height);
  if (separable()) {
    x_.resize(columns);
    y_.resize(rows);
    for (int u = 0; u < camera.width; ++u) {
      x_[static_cast<std::size_t>(u)] = static_cast<float>((u - camera.cx) / camera.fx);
    }
    for (int v = 0; v < camera.height; ++v) {
      y_[static_cast<std::size_t>(v)] = static_cast<float>((v - camera.cy) / camera.fy);
    }
    return;
  }
  x_.resize(columns * rows);
  y_.resize(columns * rows);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2f ray = camera.ray({u, v}).cast<float>();
      const std::size_t i = offset(v) + static_cast<std::size_t>(u);
      x_[i] = ray.x();
      y_[i] = ray.y();
    }
  }
}

}  // namespace dominant_plane_detection
