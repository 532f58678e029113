#include "synthetic/room_scene.h"

#include <cmath>

#include "synthetic/drawn_scene.h"
#include "synthetic/scene_random.h"

namespace dominant_plane_detection {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

void addRoom(Scene& scene, SceneRandom& random) {
  scene.add(rectangleMesh(30.0, 30.0), Eigen::Isometry3d::Identity()).ground = true;
  const double turn = random.between(-0.5, 0.5);  // the room is not in line with the view
  for (const double side : {0.0, 0.5 * kPi, -0.5 * kPi}) {
    const double away = random.between(2.0, 3.6), direction = turn + side;
    place(scene, boxMesh({0.1, 16.0, 2.5}),
          {away * std::cos(direction), away * std::sin(direction), 0.0}, direction);
  }
}

/// @return a place within view.
Eigen::Vector3d somewhere(SceneRandom& random) {
  const double x = random.between(1.0, 2.0);
  return {x, random.between(-0.4, 0.4) * x, 0.0};
}

void addRamp(Scene& scene, SceneRandom& random) {
  const double slope = random.between(6.0, 20.0) * kDegree, length = random.between(0.8, 1.5);
  place(scene, rampMesh({length, random.between(0.6, 1.2), length * std::tan(slope)}),
        somewhere(random), random.between(-0.8, 0.8));
}

void addPlatform(Scene& scene, SceneRandom& random) {
  place(scene,
        boxMesh({random.between(0.5, 1.2), random.between(0.5, 1.2), random.between(0.08, 0.3)}),
        somewhere(random), random.between(-kPi, kPi));
}

void addTable(Scene& scene, SceneRandom& random) {
  constexpr double kThick = 0.03, kLeg = 0.05;  // [m]
  const double length = random.between(0.6, 1.2), width = random.between(0.5, 0.9);
  const double height = random.between(0.5, 0.9), yaw = random.between(-kPi, kPi);
  const Eigen::Vector3d middle = somewhere(random);
  place(scene, boxMesh({length, width, kThick}),
        middle + (height - kThick) * Eigen::Vector3d::UnitZ(), yaw);
  for (const double a : {-0.5, 0.5}) {
    for (const double b : {-0.5, 0.5}) {
      const Eigen::Vector3d corner(a * (length - kLeg), b * (width - kLeg), 0.0);
      place(scene, boxMesh({kLeg, kLeg, height - kThick}),
            middle + Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * corner, yaw);
    }
  }
}

Scene draw(SceneRandom& random) {
  Scene scene;
  scene.camera = kinectCamera();
  KeyPose camera;
  camera.position.z() = random.between(0.4, 1.6);
  camera.pitch = random.between(10.0, 45.0) * kDegree;
  camera.roll = random.between(-15.0, 15.0) * kDegree;
  scene.path.keys.push_back(camera);
  addRoom(scene, random);
  const int first = random.count(0, 2), count = random.count(1, 3);
  for (int i = first; i < first + count; ++i) {
    if (i % 3 == 0) addRamp(scene, random);
    if (i % 3 == 1) addPlatform(scene, random);
    if (i % 3 == 2) addTable(scene, random);
  }
  return scene;
}

}  // namespace

Scene roomScene(std::uint32_t seed) {
  SceneRandom random(seed);
  while (true) {
    Scene scene = draw(random);
    if (showsEnoughFloor(scene)) return scene;
  }
}

}  // namespace dominant_plane_detection
