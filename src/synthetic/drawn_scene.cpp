#include "synthetic/drawn_scene.h"

#include <utility>

#include "dominant_plane_detection/detection.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {

SceneObject& place(Scene& scene, TriangleMesh mesh, const Eigen::Vector3d& position, double yaw) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = position;
  pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  return scene.add(std::move(mesh), pose);
}

bool showsEnoughFloor(const Scene& scene) {
  constexpr double kMinFloor = 0.08;  // [-] share of the image
  const Rendering rendering = Renderer(scene).render(scene.path.keys.front().pose(), {});
  std::size_t floor = 0;
  for (std::size_t i = 0; i < rendering.depth.size(); ++i) {
    floor += rendering.labels[i] == static_cast<std::uint8_t>(Label::kGround) &&
             rendering.depth[i] >= 0.5F && rendering.depth[i] <= 4.0F;
  }
  return static_cast<double>(floor) >= kMinFloor * static_cast<double>(rendering.depth.size());
}

}  // namespace dominant_plane_detection
