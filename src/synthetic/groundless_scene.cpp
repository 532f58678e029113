#include "synthetic/groundless_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "synthetic/renderer.h"
#include "synthetic/scene_random.h"

namespace dominant_plane_detection {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr double kWide = 12.0;  // [m] beyond what a camera sees
/// [-] of a surface that is no ground; the margin is for the readings that a sensor loses.
constexpr double kMaxShare = 0.04;
constexpr double kMinPixels = 0.1;   // [-] of the image, between 0.5 and 4 m
constexpr double kMaxTilt = 75.0;    // [deg] between ground and up
constexpr double kConeAngle = 10.0;  // [deg] of normals that are taken for one surface's

void place(Scene& scene, TriangleMesh mesh, const Vector3d& position,
           const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
  scene.add(std::move(mesh), Eigen::Translation3d(position) * turn);
}

Eigen::Quaterniond turned(double angle, const Vector3d& axis) {
  return Eigen::Quaterniond(AngleAxisd(angle, axis));
}

/// A camera at the origin, [deg].
void look(Scene& scene, double roll, double pitch, double yaw = 0.0) {
  KeyPose key;
  key.roll = roll * kDegree;
  key.pitch = pitch * kDegree;
  key.yaw = yaw * kDegree;
  scene.path.keys = {key};
}

/// @param ahead [m] to its face, along x before it is turned.
/// @param yaw [rad] about the camera.
void addWall(Scene& scene, double ahead, double yaw) {
  place(scene, boxMesh({0.1, kWide, kWide}),
        turned(yaw, Vector3d::UnitZ()) * Vector3d(ahead + 0.05, 0.0, -0.5 * kWide),
        turned(yaw, Vector3d::UnitZ()));
}

void addCeiling(Scene& scene, double above) {
  place(scene, boxMesh({kWide, kWide, 0.1}), {0.0, 0.0, above});
}

void drawCeiling(Scene& scene, SceneRandom& random) {
  look(scene, random.between(-60.0, 60.0), random.between(-90.0, -30.0));
  const double above = random.between(0.7, 2.2);
  addCeiling(scene, above);
  for (int i = random.count(0, 9); i > 0; --i) {
    const double hangs = random.between(0.05, 0.4);
    place(scene, boxMesh({random.between(0.1, 1.2), random.between(0.1, 0.4), hangs}),
          {random.between(-0.3, 2.0) * above, random.between(-1.0, 1.0) * above, above - hangs},
          turned(random.between(0.0, kPi), Vector3d::UnitZ()));
  }
}

void drawUpsideDown(Scene& scene, SceneRandom& random) {
  look(scene, 180.0 + random.between(-40.0, 40.0), random.between(10.0, 60.0));
  const double below = random.between(0.4, 1.5);
  place(scene, rectangleMesh(kWide, kWide), {0.0, 0.0, -below});
  for (int i = random.count(0, 9); i > 0; --i) {
    place(scene, boxMesh({random.between(0.1, 0.5), random.between(0.1, 0.5), 0.3 * below}),
          {random.between(0.8, 3.0), random.between(-1.0, 1.0), -below},
          turned(random.between(0.0, kPi), Vector3d::UnitZ()));
  }
}

void drawWall(Scene& scene, SceneRandom& random) {
  look(scene, random.between(-12.0, 12.0), random.between(-12.0, 20.0));
  const double ahead = random.between(0.7, 3.5), yaw = random.between(-60.0, 60.0) * kDegree;
  addWall(scene, ahead, yaw);
  for (int i = random.count(0, 9); i > 0; --i) {
    const double thick = random.between(0.01, 0.15);
    const Vector3d position(ahead - 0.5 * thick, random.between(-1.0, 1.0),
                            random.between(-0.8, 0.4));
    place(scene, boxMesh({thick, random.between(0.2, 1.0), random.between(0.2, 0.8)}),
          turned(yaw, Vector3d::UnitZ()) * position, turned(yaw, Vector3d::UnitZ()));
  }
}

void drawCorner(Scene& scene, SceneRandom& random) {
  look(scene, random.between(-10.0, 10.0), random.between(-12.0, 12.0));
  const double yaw = random.between(20.0, 70.0) * kDegree;
  addWall(scene, random.between(0.8, 2.5), yaw);
  addWall(scene, random.between(0.8, 2.5), yaw - 0.5 * kPi);
  if (random.chance(0.5)) addCeiling(scene, random.between(0.2, 1.0));
}

void drawSteepTable(Scene& scene, SceneRandom& random) {
  look(scene, random.between(-8.0, 8.0), 0.0);
  const double ahead = random.between(0.8, 2.0);
  // The slab lies in x and y before it is tilted: its top then faces the camera.
  const Eigen::Quaterniond tilt = turned(random.between(-35.0, 35.0) * kDegree, Vector3d::UnitZ()) *
                                  turned(-random.between(76.0, 90.0) * kDegree, Vector3d::UnitY());
  place(scene, boxMesh({random.between(0.6, 1.2), random.between(0.8, 1.6), 0.03}),
        {ahead, random.between(-0.3, 0.3), random.between(-0.3, 0.3)}, tilt);
  if (random.chance(0.6)) {  // a bench across the view, its seat nearly at the camera's height
    place(scene, boxMesh({0.3, random.between(1.0, 3.0), 0.4}),
          {ahead + random.between(0.3, 1.0), 0.0, -0.5 + random.between(0.0, 0.2)});
  }
  if (random.chance(0.7)) addWall(scene, ahead + random.between(0.8, 2.0), 0.0);
}

/// @param eyes [m] of the figure above the camera.
void addFigure(Scene& scene, SceneRandom& random, const Vector3d& place_xy, double eyes) {
  const double size = random.between(0.85, 1.1), yaw = random.between(0.0, 2.0 * kPi);
  const Eigen::Quaterniond turn = turned(yaw, Vector3d::UnitZ());
  const Vector3d head = place_xy + Vector3d(0.0, 0.0, eyes);
  const auto add = [&](TriangleMesh mesh, const Vector3d& below_head) {
    place(scene, std::move(mesh), head + turn * (size * below_head), turn);
  };
  add(ellipsoidMesh(size * Vector3d(0.09, 0.08, 0.12)), {0.0, 0.0, 0.0});
  add(ellipsoidMesh(size * Vector3d(0.14, 0.21, 0.36)), {0.0, 0.0, -0.48});
  for (const double side : {-1.0, 1.0}) {
    add(ellipsoidMesh(size * Vector3d(0.05, 0.05, 0.34)), {0.0, side * 0.26, -0.56});
    add(cylinderMesh(0.08 * size, 0.85 * size), {0.0, side * 0.1, -1.6});
  }
}

void drawPeople(Scene& scene, SceneRandom& random) {
  look(scene, random.between(-10.0, 10.0), random.between(-10.0, 5.0));
  for (int i = random.count(1, 4); i > 0; --i) {
    const double ahead = random.between(1.0, 3.0);
    addFigure(scene, random, {ahead, random.between(-0.45, 0.45) * ahead, 0.0},
              random.between(-0.1, 0.6));
  }
  if (random.chance(0.5)) addWall(scene, random.between(3.2, 4.5), random.between(-0.5, 0.5));
}

void drawSpheres(Scene& scene, SceneRandom& random) {
  look(scene, random.between(-12.0, 12.0), random.between(-12.0, 12.0));
  for (int i = random.count(1, 6); i > 0; --i) {
    const double radius = random.between(0.1, 0.9), ahead = radius + random.between(0.6, 2.5);
    place(scene, ellipsoidMesh(Vector3d::Constant(radius)),
          {ahead, random.between(-0.5, 0.5) * ahead, random.between(-0.4, 0.4) * ahead});
  }
  if (random.chance(0.5)) addWall(scene, random.between(2.5, 4.5), random.between(-0.6, 0.6));
}

void drawCurtain(Scene& scene, SceneRandom& random) {
  look(scene, random.between(-10.0, 10.0), random.between(-10.0, 10.0));
  const double fold = random.between(0.1, 0.5), bulge = random.between(0.6, 1.5);  // [m] waves
  const double folds = random.between(0.05, 0.25) * fold,
               bulges = random.between(0.0, 0.02) * bulge;
  const double start = random.between(0.0, 2.0 * kPi);
  const auto depth = [=](double y, double z) {
    return folds * std::sin(2.0 * kPi * y / fold + start) +
           bulges * std::sin(2.0 * kPi * z / bulge + 3.0 * y);
  };
  place(scene, curtainMesh(5.0, 3.5, depth), {random.between(0.9, 3.0), 0.0, -1.75},
        turned(random.between(-0.6, 0.6), Vector3d::UnitZ()));
}

Scene draw(GroundlessKind kind, SceneRandom& random) {
  Scene scene;
  scene.camera = kinectCamera();
  switch (kind) {
    case GroundlessKind::kCeiling:
      drawCeiling(scene, random);
      break;
    case GroundlessKind::kUpsideDown:
      drawUpsideDown(scene, random);
      break;
    case GroundlessKind::kWall:
      drawWall(scene, random);
      break;
    case GroundlessKind::kCorner:
      drawCorner(scene, random);
      break;
    case GroundlessKind::kSteepTable:
      drawSteepTable(scene, random);
      break;
    case GroundlessKind::kPeople:
      drawPeople(scene, random);
      break;
    case GroundlessKind::kSpheres:
      drawSpheres(scene, random);
      break;
    case GroundlessKind::kCurtain:
      drawCurtain(scene, random);
      break;
  }
  return scene;
}

bool inRange(float depth) { return depth >= 0.5F && depth <= 4.0F; }

bool isGroundless(const Scene& scene) {
  Layers layers;
  layers.surface_normals = true;
  const Rendering rendering = Renderer(scene).render(scene.path.keys.front().pose(), layers);
  const auto seen = std::count_if(rendering.depth.begin(), rendering.depth.end(), inRange);
  return static_cast<double>(seen) >= kMinPixels * static_cast<double>(rendering.depth.size()) &&
         largestGroundShare(rendering) < kMaxShare;
}

/// Directions within kMaxTilt of up, no point of that cap farther than about 3 degrees from one.
std::vector<Eigen::Vector3f> upwardDirections() {
  constexpr double kStep = 4.0;  // [deg]
  std::vector<Eigen::Vector3f> directions;
  for (double tilt = 0.0; tilt <= kMaxTilt; tilt += kStep) {
    const int around = std::max(1, static_cast<int>(360.0 / kStep * std::sin(tilt * kDegree)) + 1);
    for (int i = 0; i < around; ++i) {
      const double turn = 2.0 * kPi * i / around, down = tilt * kDegree;
      directions.push_back(Vector3d(std::sin(down) * std::cos(turn), -std::cos(down),
                                    std::sin(down) * std::sin(turn))
                               .cast<float>());
    }
  }
  return directions;
}

}  // namespace

GroundlessKind groundlessKind(std::uint32_t seed) {
  return static_cast<GroundlessKind>(seed % kGroundlessKinds);
}

Scene groundlessScene(std::uint32_t seed) {
  SceneRandom random(seed);
  while (true) {
    Scene scene = draw(groundlessKind(seed), random);
    if (isGroundless(scene)) return scene;
  }
}

double largestGroundShare(const Rendering& rendering) {
  const auto cone = static_cast<float>(std::cos(kConeAngle * kDegree));
  const auto max_tilt = static_cast<float>(std::cos(kMaxTilt * kDegree));
  std::size_t valid = 0;
  std::vector<Eigen::Vector3f> upward;
  for (std::size_t i = 0; i < rendering.depth.size(); ++i) {
    if (!inRange(rendering.depth[i])) continue;
    ++valid;
    const Eigen::Vector3f& normal = rendering.surface_normals[i];
    if (-normal.y() >= max_tilt) upward.push_back(normal);
  }
  if (valid == 0) return std::numeric_limits<double>::quiet_NaN();
  std::ptrdiff_t largest = 0;
  for (const Eigen::Vector3f& direction : upwardDirections()) {
    const auto one_surface = [&](const Eigen::Vector3f& n) { return n.dot(direction) >= cone; };
    largest = std::max(largest, std::count_if(upward.begin(), upward.end(), one_surface));
  }
  return static_cast<double>(largest) / static_cast<double>(valid);
}

}  // namespace dominant_plane_detection
