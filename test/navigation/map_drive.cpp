#include "navigation/map_drive.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <vector>

#include "navigation/ground_frame.h"
#include "navigation/local_map.h"
#include "navigation/room_things.h"
#include "navigation/told_height.h"
#include "synthetic/drawn_scene.h"
#include "synthetic/renderer.h"
#include "synthetic/scene_random.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kCell = 0.05, kSize = 8.0, kMemory = 10.0;
constexpr double kCameraAhead = 0.1, kHeight = 0.45, kPitch = 20.0 * kDegree, kSpeed = 0.45;
constexpr std::size_t kWalls = 4;  // which may be outside of a map that has all else in it
constexpr double kTold = 0.05;     // [m]
constexpr double kArea = 0.5 * kCell * kCell;  // [m^2] of things in a cell that counts

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

/// What the exact images have shown, over the world.
class Seen {
 public:
  using Cell = std::pair<int, int>;
  static Cell cellOf(const Eigen::Vector2d& point) {
    return {static_cast<int>(std::floor(point.x() / kCell)),
            static_cast<int>(std::floor(point.y() / kCell))};
  }

  void add(double time, const Room& room, const Rendering& exact, const Eigen::Isometry3d& camera,
           double free_range) {
    RayTable rays;
    rays.build(room.scene.camera);
    std::set<Cell> floor;
    std::map<Cell, double> obstacles;
    const double pixel = 1.0 / (room.scene.camera.fx * room.scene.camera.fy);
    std::vector<double> areas(room.things.size(), 0.0);
    for (int v = 0; v < exact.height; ++v) {
      for (int u = 0; u < exact.width; ++u) {
        const std::size_t i = static_cast<std::size_t>(v * exact.width + u);
        const double z = static_cast<double>(exact.depth[i]);
        if (!(z > 0.5 && z < free_range)) continue;
        const Eigen::Vector3d at = camera * (z * rays.ray(u, v).cast<double>());
        if (exact.labels[i] == static_cast<std::uint8_t>(Label::kGround)) {
          floor.insert(cellOf(at.head<2>()));
          continue;
        }
        obstacles[cellOf(at.head<2>())] += pixel * z * z;
        for (std::size_t k = 0; k < room.things.size(); ++k) {
          if (room.things[k].distanceTo(at.head<2>()) < 0.003) areas[k] += pixel * z * z;
        }
      }
    }
    for (const Cell& cell : floor) floor_[cell].push_back(time);
    for (const auto& [cell, area] : obstacles) {
      if (area >= kArea) obstacles_[cell].push_back(time);
    }
    things_.resize(areas.size());
    for (std::size_t k = 0; k < areas.size(); ++k) {
      if (areas[k] >= 2.0 * kArea) things_[k].push_back(time);
    }
  }
  bool floor(const Cell& cell, double now) const { return lately(floor_, cell, now); }
  bool obstacle(const Cell& cell, double now) const { return lately(obstacles_, cell, now); }
  bool thing(std::size_t k, double now) const { return lately(things_[k], now); }

 private:
  using Times = std::map<Cell, std::vector<double>>;
  static bool lately(const Times& times, const Cell& cell, double now) {
    const auto found = times.find(cell);
    return found != times.end() && lately(found->second, now);
  }
  static bool lately(const std::vector<double>& times, double now) {
    return times.size() >= 3 && times[times.size() - 3] > now - kMemory;
  }

  Times floor_, obstacles_;
  std::vector<std::vector<double>> things_;
};

/// @return the cells of which an exact image shows floor.
std::set<Seen::Cell> floorCells(const Rendering& exact, const RayTable& rays,
                                const Eigen::Isometry3d& camera, double free_range) {
  std::set<Seen::Cell> cells;
  for (int v = 0; v < exact.height; ++v) {
    for (int u = 0; u < exact.width; ++u) {
      const std::size_t i = static_cast<std::size_t>(v * exact.width + u);
      const double z = static_cast<double>(exact.depth[i]);
      const bool floor = exact.labels[i] == static_cast<std::uint8_t>(Label::kGround);
      if (!floor || !(z > 0.5 && z < free_range)) continue;
      const Eigen::Vector3d at = camera * (z * rays.ray(u, v).cast<double>());
      cells.insert(Seen::cellOf(at.head<2>()));
    }
  }
  return cells;
}

/// A map against the plan, cell by cell of the map.
class Comparison {
 public:
  /// @param T_world_map where odometry has the robot now.
  Comparison(const LocalMap& map, const Room& room, const Seen& seen, double now,
             const Eigen::Isometry2d& T_world_map)
      : cells_(map.grid().cells()) {
    const std::size_t all = map.grid().size();
    for (auto* cells : {&free_, &occupied_, &true_free_, &counts_, &thing_, &seen_thing_}) {
      cells->resize(all);
    }
    for (int y = 0; y < cells_; ++y) {
      for (int x = 0; x < cells_; ++x) {
        const Eigen::Vector2d place =
            T_world_map * (map.grid().origin() + kCell * Eigen::Vector2d(x + 0.5, y + 0.5));
        const std::size_t i = at(x, y);
        free_[i] = map.state(x, y) == LocalMap::kFree;
        occupied_[i] = map.state(x, y) == LocalMap::kOccupied;
        counts_[i] = seen.floor(Seen::cellOf(place), now);
        seen_thing_[i] = seen.obstacle(Seen::cellOf(place), now);
        const bool low = std::any_of(room.things.begin(), room.things.end(), [&](const Thing& t) {
          return t.distanceTo(place) < 0.5 * kCell;
        });
        thing_[i] = low;
        true_free_[i] = counts_[i] && !low;
      }
    }
  }

  void judge(MapFigures& figures) const {
    int both = 0, one = 0;
    forEach([&](int x, int y, std::size_t i) {
      if (true_free_[i]) ++(near(free_, x, y) ? both : one);
      if (free_[i] && counts_[i] && !near(true_free_, x, y)) ++one;
      figures.left_free += free_[i] && seen_thing_[i] && !near(occupied_, x, y);
      figures.obstacle_cells += seen_thing_[i];
    });
    if (both + one < 50) return;
    const double iou = static_cast<double>(both) / (both + one);
    ++figures.maps;
    figures.sum_iou += iou;
    figures.least_iou = std::min(figures.least_iou, iou);
  }
  /// @return whether a cell on a thing, or next to it, is occupied.
  bool shows(const Thing& thing, const LocalMap& map, const Eigen::Isometry2d& T_world_map) const {
    bool shown = false;
    forEach([&](int x, int y, std::size_t i) {
      const Eigen::Vector2d place =
          T_world_map * (map.grid().origin() + kCell * Eigen::Vector2d(x + 0.5, y + 0.5));
      shown = shown || (occupied_[i] && thing.distanceTo(place) < 1.5 * kCell);
    });
    return shown;
  }
  cv::Mat picture() const {
    cv::Mat image(cells_, 2 * cells_ + 4, CV_8UC3, cv::Scalar(255, 255, 255));
    forEach([&](int x, int y, std::size_t i) {
      const cv::Vec3b map = occupied_[i] ? cv::Vec3b(0, 0, 0)
                            : free_[i]   ? cv::Vec3b(240, 240, 240)
                                         : cv::Vec3b(150, 140, 120);
      const cv::Vec3b plan = thing_[i]       ? cv::Vec3b(0, 0, 0)
                             : true_free_[i] ? cv::Vec3b(240, 240, 240)
                                             : cv::Vec3b(150, 140, 120);
      image.at<cv::Vec3b>(cells_ - 1 - y, x) = map;
      image.at<cv::Vec3b>(cells_ - 1 - y, cells_ + 4 + x) = plan;
    });
    cv::Mat large;
    cv::resize(image, large, {}, 4, 4, cv::INTER_NEAREST);
    return large;
  }

 private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * cells_ + x); }
  template <typename Visit>
  void forEach(Visit&& visit) const {
    for (int y = 0; y < cells_; ++y) {
      for (int x = 0; x < cells_; ++x) visit(x, y, at(x, y));
    }
  }
  /// @return whether one of a cell and those about it is in a set.
  bool near(const std::vector<bool>& cells, int x, int y) const {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, cells_ - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, cells_ - 1); ++i) {
        if (cells[at(i, j)]) return true;
      }
    }
    return false;
  }

  int cells_;
  std::vector<bool> free_, occupied_, true_free_, counts_, thing_, seen_thing_;
};

Eigen::Isometry3d in3d(const Eigen::Isometry2d& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translation().head<2>() = pose.translation();
  result.linear().topLeftCorner<2, 2>() = pose.linear();
  return result;
}

MapLimits limitsOf(const Parameters& parameters) {
  MapLimits limits;
  limits.noise = parameters.noise;
  limits.free_range = freeRange(parameters.local_error, kTold);
  return limits;
}

/// @return T_base_optical
Eigen::Isometry3d mountOfRobot() {
  return KeyPose{0.0, {kCameraAhead, 0.0, kHeight}, 0.0, kPitch, 0.0}.pose();
}

Prior priorOf(const Eigen::Isometry3d& mount) {
  Prior prior;
  prior.expected_up = mount.linear().transpose() * Eigen::Vector3d::UnitZ();
  prior.up_source = UpSource::kTf;
  prior.expected_height = Prior::ExpectedHeight{kHeight, 0.125};
  return prior;
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
    seen.add(time, room, exact, camera, limits.free_range);
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
      const Comparison comparison(map, room, seen, time, T_world_map);
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
  std::set<Seen::Cell> occupied, freed;
  const auto stateAt = [&](const Seen::Cell& cell) {
    const Eigen::Vector2d place((cell.first + 0.5) * kCell, (cell.second + 0.5) * kCell);
    const Eigen::Vector2d at = (place - map.grid().origin()) / kCell;
    return map.state(static_cast<int>(at.x()), static_cast<int>(at.y()));
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
        const Seen::Cell cell = Seen::cellOf({x, y});
        if (stateAt(cell) == LocalMap::kOccupied) occupied.insert(cell);
      }
    }
    for (const Seen::Cell& cell : occupied) {
      if (time >= kGoes && stateAt(cell) == LocalMap::kFree) freed.insert(cell);
    }
    if (frame < frames) continue;
    const std::set<Seen::Cell> floor = floorCells(exact, rays, camera, limits.free_range);
    figures.occupied = static_cast<int>(occupied.size());
    for (const Seen::Cell& cell : occupied) {
      if (floor.count(cell) == 0) continue;
      ++figures.trace;
      figures.left += freed.count(cell) == 0;
    }
  }
  return figures;
}

}  // namespace dominant_plane_detection
