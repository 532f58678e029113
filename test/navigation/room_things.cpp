#include "navigation/room_things.h"

#include <algorithm>
#include <cmath>

#include "synthetic/drawn_scene.h"
#include "synthetic/scene_random.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = M_PI / 180.0;

RoomOfThings draw(SceneRandom& random, double apart) {
  RoomOfThings room;
  Scene& scene = room.scene;
  scene.camera = kinectCamera();
  scene.path.keys.push_back({0.0,
                             {0.0, 0.0, random.between(0.4, 1.0)},
                             (random.chance(0.5) ? 10.0 : -10.0) * kDegree,
                             20.0 * kDegree,
                             0.0});
  scene.add(rectangleMesh(30.0, 30.0), Eigen::Isometry3d::Identity()).ground = true;
  for (const double side : {0.0, 0.5 * M_PI, -0.5 * M_PI}) {
    const double away = random.between(3.9, 5.0);
    place(scene, boxMesh({0.1, 16.0, 2.5}), {away * std::cos(side), away * std::sin(side), 0.0},
          side);
  }
  for (int i = random.count(3, 6); i > 0; --i) {
    const double x = random.between(0.9, 3.4);
    Thing thing{{x, random.between(-0.5, 0.5) * x},
                random.between(-M_PI, M_PI),
                {random.between(0.05, 0.4), random.between(0.05, 0.4),
                 random.chance(0.5) ? random.between(0.02, 0.1) : random.between(0.1, 0.6)},
                random.chance(0.4)};
    const double reach = 0.5 * thing.size.head<2>().norm();
    const bool alone =
        std::none_of(room.things.begin(), room.things.end(), [&](const Thing& other) {
          return (other.place - thing.place).norm() <
                 apart + reach + 0.5 * other.size.head<2>().norm();
        });
    if (apart > 0.0 && !alone) continue;
    addThing(scene, thing);
    room.things.push_back(thing);
  }
  return room;
}

}  // namespace

double Thing::distanceTo(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d at = inside(point);
  if (round) return std::max(at.norm() - 0.5 * size.x(), 0.0);
  return (at.cwiseAbs() - 0.5 * size.head<2>()).cwiseMax(0.0).norm();
}

bool Thing::contains(const Eigen::Vector3d& point) const {
  constexpr double kSkin = 0.003;  // [m] a post is a prism
  return point.z() <= size.z() + kSkin && distanceTo(point.head<2>()) < kSkin;
}

void addThing(Scene& scene, const Thing& thing) {
  place(scene,
        thing.round ? cylinderMesh(0.5 * thing.size.x(), thing.size.z()) : boxMesh(thing.size),
        {thing.place.x(), thing.place.y(), 0.0}, thing.yaw);
}

RoomOfThings roomOfThings(std::uint32_t seed, double apart) {
  SceneRandom random(seed);
  while (true) {
    RoomOfThings room = draw(random, apart);
    if (showsEnoughFloor(room.scene)) return room;
  }
}

}  // namespace dominant_plane_detection
