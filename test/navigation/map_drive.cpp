#include "navigation/map_drive.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "navigation/map_plan.h"
#include "navigation/map_robot.h"
#include "navigation/room_things.h"
#include "synthetic/drawn_scene.h"
#include "synthetic/renderer.h"
#include "synthetic/scene_random.h"

namespace dominant_plane_detection {
namespace {

constexpr double kSpeed = 0.45;    // [m/s]
constexpr std::size_t kWalls = 4;  // which may be outside of a map that has all else in it

/// The robot's way: an ellipse.
struct Way {
  double a, b, side;  ///< [m], [m], 1 or -1
  /// T_world_base at a time, with the speed along the way.
  Eigen::Isometry2d at(double angle) const {
    Eigen::Isometry2d pose = Eigen::Isometry2d::Identity();
    pose.translation() = Eigen::Vector2d(a * std::cos(angle), side * b * std::sin(angle));
    const Eigen::Vector2d ahead(-a * std::sin(angle), side * b * std::cos(angle));
    pose.linear() = Eigen::Rotation2Dd(std::atan2(ahead.y(), ahead.x())).toRotationMatrix();
    return pose;
  }
  double step(double angle) const {
    return kSpeed / std::hypot(a * std::sin(angle), b * std::cos(angle));
  }
  double distanceTo(const Thing& thing) const {
    double nearest = INFINITY;
    for (double angle = 0.0; angle < 2.0 * M_PI; angle += 0.05) {
      nearest = std::min(nearest, thing.distanceTo(at(angle).translation()));
    }
    return nearest;
  }
};

struct Room {
  Scene scene;
  std::vector<Thing> things;  ///< walls first
  Way way;
};

void add(Room& room, const Thing& thing) {
  addThing(room.scene, thing);
  room.things.push_back(thing);
}

void addTable(Room& room, const Thing& table) {
  constexpr double kThick = 0.03, kLeg = 0.05;
  place(room.scene, boxMesh({table.size.x(), table.size.y(), kThick}),
        {table.place.x(), table.place.y(), table.size.z() - kThick}, table.yaw);
  for (const double i : {-0.5, 0.5}) {
    for (const double j : {-0.5, 0.5}) {
      const Eigen::Vector2d corner(i * (table.size.x() - kLeg), j * (table.size.y() - kLeg));
      const Eigen::Vector2d at = table.place + Eigen::Rotation2Dd(table.yaw) * corner;
      place(room.scene, boxMesh({kLeg, kLeg, table.size.z() - kThick}), {at.x(), at.y(), 0.0},
            table.yaw);
    }
  }
  room.things.push_back(table);
}

Room drawRoom(std::uint32_t seed) {
  SceneRandom random(seed);
  Room room;
  room.scene.camera = kinectCamera();
  room.scene.add(rectangleMesh(30.0, 30.0), Eigen::Isometry3d::Identity()).ground = true;
  room.way = {random.between(1.5, 2.2), random.between(1.2, 1.8), random.chance(0.5) ? 1.0 : -1.0};
  const double length = room.way.a + random.between(0.9, 1.6);
  const double width = room.way.b + random.between(0.9, 1.6);
  for (const double sign : {-1.0, 1.0}) {
    add(room, {{sign * (length + 0.05), 0.0}, 0.0, {0.1, 2.0 * width + 0.2, 2.5}, false});
    add(room, {{0.0, sign * (width + 0.05)}, 0.0, {2.0 * length + 0.2, 0.1, 2.5}, false});
  }
  int wanted = random.count(7, 12);
  for (int tries = 0; wanted > 0 && tries < 1000; ++tries) {
    const bool table = wanted == 1;
    Thing thing{
        {random.between(-length + 0.5, length - 0.5), random.between(-width + 0.5, width - 0.5)},
        random.between(-M_PI, M_PI),
        {random.between(0.08, 0.5), random.between(0.08, 0.5),
         random.chance(0.4) ? random.between(0.05, 0.1) : random.between(0.1, 0.8)},
        random.chance(0.4)};
    if (table) thing = {thing.place, thing.yaw, {0.7, 0.5, random.between(0.55, 0.75)}, false};
    if (thing.round) thing.size.y() = thing.size.x();
    if (room.way.distanceTo(thing) < 0.35) continue;
    table ? addTable(room, thing) : add(room, thing);
    --wanted;
  }
  return room;
}

}  // namespace

MapFigures driveThroughRoom(std::uint32_t seed, ErrorKind error, double seconds, double rate,
                            const std::string& picture) {
  const Room room = drawRoom(seed);
  const Renderer renderer(room.scene);
  SceneRandom random(1000 + seed);
  const double way_error = random.between(-0.01, 0.01), turn_error = random.between(-0.01, 0.01);
  DominantPlaneDetector detector(parametersOf(error));
  const MapLimits limits = limitsOf(detector.parameters());
  LocalMap map(kCell, kSize, kMemory);
  RayTable rays;
  rays.build(room.scene.camera);
  Seen seen;
  MapFigures figures;
  const Eigen::Isometry3d mount = mountOfRobot();
  double angle = random.between(0.0, 2.0 * M_PI);
  Eigen::Isometry2d base = room.way.at(angle);
  Eigen::Isometry2d odometry = Eigen::Isometry2d::Identity();
  const int frames = static_cast<int>(seconds * rate);
  for (int frame = 0; frame < frames; ++frame) {
    const double time = frame / rate;
    const Eigen::Isometry3d camera = in3d(base) * mount;
    Layers layers;
    layers.shadow = true;
    const Rendering exact = renderer.render(camera, layers);
    const auto pixels = readDepth(exact, error, 100000 * seed + static_cast<unsigned>(frame));
    const DepthView view(pixels.data(), exact.width, exact.height);
    const Detection& detection = detector.detect(view, room.scene.camera, priorOf(mount));
    seen.add(time, room.scene, room.things, exact, camera, limits.free_range);
    if (detection.found()) {
      Eigen::Isometry2d ground = odometry;
      ground.translate(Eigen::Vector2d(kCameraAhead, 0.0));
      const auto begin = std::chrono::steady_clock::now();
      map.add(time, view, rays, detection, limits, ground);
      const std::chrono::duration<double, std::milli> took =
          std::chrono::steady_clock::now() - begin;
      figures.sum_milliseconds += took.count();
      ++figures.images;
    }
    const bool last = frame + 1 == frames;
    if (last || (time > 3.0 && frame % static_cast<int>(4.0 * rate) == 0)) {
      const Eigen::Isometry2d T_world_map = base * odometry.inverse();
      const Comparison comparison(map, room.things, seen, time, T_world_map);
      comparison.judge(figures);
      for (std::size_t k = kWalls; k < room.things.size(); ++k) {
        if (!seen.thing(k, time)) continue;
        ++figures.things;
        figures.missed += !comparison.shows(room.things[k], map, T_world_map);
      }
      if (last && !picture.empty()) cv::imwrite(picture, comparison.picture());
    }
    angle += room.way.step(angle) / rate;
    const Eigen::Isometry2d next = room.way.at(angle), moved = base.inverse() * next;
    const double turn = Eigen::Rotation2Dd(moved.linear()).smallestAngle();
    odometry.translate(Eigen::Vector2d((1.0 + way_error) * moved.translation()));
    odometry.rotate(Eigen::Rotation2Dd((1.0 + turn_error) * turn));
    base = next;
  }
  return figures;
}

}  // namespace dominant_plane_detection
