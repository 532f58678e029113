#include "synthetic/scene.h"

#include <utility>

namespace dominant_plane_detection {

SceneObject& Scene::add(TriangleMesh mesh, const Eigen::Isometry3d& pose) {
  mesh.transform(pose);
  objects.emplace_back();
  objects.back().mesh = std::move(mesh);
  return objects.back();
}

CameraModel kinectCamera() {
  CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 580.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

}  // namespace dominant_plane_detection
