#include "synthetic/ground_scenes.h"

#include <cmath>

namespace dominant_plane_detection {
namespace {

constexpr double kWide = 30.0;  // [m] beyond what a camera sees

Scene sceneFrom(double camera_height, double pitch) {
  Scene scene;
  scene.camera = kinectCamera();
  KeyPose key;
  key.position.z() = camera_height;
  key.pitch = pitch;
  scene.path.keys.push_back(key);
  return scene;
}

void place(Scene& scene, TriangleMesh mesh, const Eigen::Vector3d& position, bool ground = false) {
  scene.add(std::move(mesh), Eigen::Isometry3d(Eigen::Translation3d(position))).ground = ground;
}

void addFloor(Scene& scene) { place(scene, rectangleMesh(kWide, kWide), {0.0, 0.0, 0.0}, true); }

}  // namespace

Scene plateScene(double height, double ahead) {
  constexpr double kSide = 0.8;
  Scene scene = sceneFrom(0.6, 0.4);
  addFloor(scene);
  place(scene, boxMesh({kSide, kSide, height}), {ahead + 0.5 * kSide, 0.0, 0.0});
  return scene;
}

Scene kerbScene(double height, double aside) {
  Scene scene = sceneFrom(0.6, 0.4);
  addFloor(scene);
  place(scene, boxMesh({kWide, 0.5 * kWide, height}), {0.0, aside + 0.25 * kWide, 0.0});
  return scene;
}

Scene rampScene(double slope, double ahead) {
  constexpr double kLength = 1.2;
  Scene scene = sceneFrom(0.6, 0.4);
  addFloor(scene);
  place(scene, rampMesh({kLength, kLength, kLength * std::tan(slope)}),
        {ahead + 0.5 * kLength, 0.0, 0.0});
  return scene;
}

Scene twoLevelScene(double step, double ahead) {
  Scene scene = sceneFrom(0.8, 0.5);
  place(scene, rectangleMesh(kWide, kWide), {ahead - 0.5 * kWide, 0.0, 0.0}, true);
  if (step > 0.0) {
    place(scene, boxMesh({kWide, kWide, step}), {ahead + 0.5 * kWide, 0.0, 0.0});
  } else {
    place(scene, rectangleMesh(2.0 * kWide, kWide), {ahead, 0.0, step});
  }
  return scene;
}

Scene doorSillScene(double height, double ahead) {
  constexpr double kDoor = 0.9, kDepth = 0.1;  // [m]
  Scene scene = sceneFrom(0.6, 0.3);
  addFloor(scene);
  const double x = ahead + 0.5 * kDepth;
  for (const double side : {-1.0, 1.0}) {
    place(scene, boxMesh({kDepth, kWide, 2.5}), {x, side * 0.5 * (kDoor + kWide), 0.0});
  }
  place(scene, boxMesh({kDepth, kDoor, height}), {x, 0.0, 0.0});
  return scene;
}

Scene tableScene(double height, double ahead) {
  const Eigen::Vector3d top(0.8, 1.6, 0.03), leg(0.06, 0.06, height - top.z());  // [m]
  Scene scene = sceneFrom(height + 0.5, 0.6);
  addFloor(scene);
  const double x = ahead + 0.5 * top.x();
  place(scene, boxMesh(top), {x, 0.0, leg.z()});
  for (const double side : {-1.0, 1.0}) {
    for (const double end : {-1.0, 1.0}) {
      place(scene, boxMesh(leg), {x + side * 0.35, end * 0.75, 0.0});
    }
  }
  return scene;
}

}  // namespace dominant_plane_detection
