#include "navigation/person_walk.h"

#include <set>

#include "navigation/map_robot.h"
#include "synthetic/drawn_scene.h"
#include "synthetic/renderer.h"
#include "synthetic/scene_random.h"

namespace dominant_plane_detection {

namespace {

/// @return whether a cell and all about it are in a set: it is not at the border of the view.
bool isWithin(const std::set<WorldCell>& cells, const WorldCell& cell) {
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      if (cells.count({cell.first + x, cell.second + y}) == 0) return false;
    }
  }
  return true;
}

}  // namespace

PersonFigures letPersonWalkPast(ErrorKind error, std::uint32_t seed, double speed, double rate) {
  constexpr double kGoes = 3.0, kWalks = 1.0, kAfter = 3.0;  // [s], [m/s], [s]
  SceneRandom random(seed);
  const double ahead = random.between(1.6, 2.4);
  const auto personAt = [&](double time) {
    return Eigen::Vector2d(ahead, kWalks * (time - 0.5 * kGoes));
  };
  DominantPlaneDetector detector(parametersOf(error));
  const MapLimits limits = limitsOf(detector.parameters());
  LocalMap map(kCell, kSize, kMemory);
  RayTable rays;
  rays.build(kinectCamera());
  const Eigen::Isometry3d mount = mountOfRobot();
  std::set<WorldCell> occupied, freed;
  const auto stateAt = [&](const WorldCell& cell) {
    const Eigen::Vector2d place((cell.first + 0.5) * kCell, (cell.second + 0.5) * kCell);
    const Eigen::Vector2d at = (place - map.grid().origin()) / kCell;
    const bool inside = at.minCoeff() >= 0.0 && at.maxCoeff() < map.grid().cells();
    return inside ? map.state(static_cast<int>(at.x()), static_cast<int>(at.y()))
                  : LocalMap::kUnknown;
  };
  PersonFigures figures;
  const int frames = static_cast<int>((kGoes + kAfter) * rate);
  for (int frame = 0; frame <= frames; ++frame) {
    const double time = frame / rate;
    Scene scene;
    scene.camera = kinectCamera();
    scene.add(rectangleMesh(30.0, 30.0), Eigen::Isometry3d::Identity()).ground = true;
    place(scene, boxMesh({0.1, 16.0, 2.5}), {5.0, 0.0, 0.0}, 0.0);
    if (time < kGoes) {
      const Eigen::Vector2d person = personAt(time);
      place(scene, cylinderMesh(0.2, 1.7), {person.x(), person.y(), 0.0}, 0.0);
    }
    Eigen::Isometry2d base = Eigen::Isometry2d::Identity();
    base.translation().x() = speed * time;
    const Eigen::Isometry3d camera = in3d(base) * mount;
    Layers layers;
    layers.shadow = true;
    const Rendering exact = Renderer(scene).render(camera, layers);
    const auto pixels = readDepth(exact, error, 1000 * seed + static_cast<unsigned>(frame));
    const DepthView view(pixels.data(), exact.width, exact.height);
    const Detection& detection = detector.detect(view, scene.camera, priorOf(mount));
    if (detection.found()) {
      base.translate(Eigen::Vector2d(kCameraAhead, 0.0));
      map.add(time, view, rays, detection, limits, base);
    }
    for (double y = -kWalks * kGoes; time < kGoes && y < kWalks * kGoes; y += kCell) {
      for (double x = ahead - 0.3; x < ahead + 0.3; x += kCell) {
        const WorldCell cell = cellOf({x, y});
        if (stateAt(cell) == LocalMap::kOccupied) occupied.insert(cell);
      }
    }
    for (const WorldCell& cell : occupied) {
      if (time >= kGoes && stateAt(cell) == LocalMap::kFree) freed.insert(cell);
    }
    if (frame < frames) continue;
    const std::set<WorldCell> floor = floorCells(exact, rays, camera, limits.free_range);
    figures.occupied = static_cast<int>(occupied.size());
    for (const WorldCell& cell : occupied) {
      if (!isWithin(floor, cell)) continue;
      ++figures.trace;
      figures.left += freed.count(cell) == 0;
    }
  }
  return figures;
}

}  // namespace dominant_plane_detection
