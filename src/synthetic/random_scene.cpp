#include "synthetic/random_scene.h"

#include <algorithm>

#include "synthetic/drawn_scene.h"
#include "synthetic/scene_random.h"

namespace dominant_plane_detection {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

void addRoom(Scene& scene, SceneRandom& random) {
  SceneObject& floor = scene.add(rectangleMesh(30.0, 30.0), Eigen::Isometry3d::Identity());
  floor.ground = true;
  floor.tiles = 0.4;
  const Eigen::Vector3d paint(0.8, 0.78, 0.7);
  const double turn = random.between(-0.4, 0.4);  // the room is not in line with the view
  for (const double side : {0.0, 0.5 * kPi, -0.5 * kPi}) {
    const double away = random.between(2.5, 6.0), direction = turn + side;
    place(scene, boxMesh({0.1, 16.0, 2.5}),
          {away * std::cos(direction), away * std::sin(direction), 0.0}, direction)
        .colour = paint;
  }
}

void addThings(Scene& scene, SceneRandom& random) {
  const int count = static_cast<int>(random.between(2.0, 9.0));
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d colour(random.between(0.2, 0.9), random.between(0.2, 0.9),
                                 random.between(0.2, 0.9));
    const Eigen::Vector3d size(random.between(0.05, 0.8), random.between(0.05, 0.8),
                               random.between(0.05, 0.8));
    const double x = random.between(0.7, 3.5);
    const Eigen::Vector3d position(x, random.between(-0.6, 0.6) * x, 0.0);
    const double yaw = random.between(-kPi, kPi);
    const bool round = random.between(0.0, 1.0) < 0.4;
    place(scene, round ? cylinderMesh(0.5 * size.x(), size.z()) : boxMesh(size), position, yaw)
        .colour = colour;
  }
}

Scene draw(std::uint32_t seed, SceneRandom& random) {
  Scene scene;
  scene.camera = kinectCamera();
  KeyPose camera;
  camera.position = {0.0, 0.0, random.between(0.3, 1.5)};
  camera.pitch = random.between(10.0, 50.0) * kDegree;
  camera.roll = random.between(-15.0, 15.0) * kDegree;
  scene.path.keys.push_back(camera);
  addRoom(scene, random);
  addThings(scene, random);
  if (seed % 3 == 0) {
    // Across the view, about where the optical axis meets the floor.
    const double x = std::clamp(camera.position.z() / std::tan(camera.pitch), 1.0, 3.0);
    place(scene, boxMesh({0.1, 8.0, random.between(0.08, 0.15)}), {x, 0.0, 0.0},
          random.between(-0.2, 0.2))
        .colour = {0.5, 0.3, 0.2};
  }
  return scene;
}

}  // namespace

Scene randomScene(std::uint32_t seed) {
  SceneRandom random(seed);
  while (true) {
    Scene scene = draw(seed, random);
    if (showsEnoughFloor(scene)) return scene;
  }
}

}  // namespace dominant_plane_detection
