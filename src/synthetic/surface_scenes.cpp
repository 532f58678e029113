#include "synthetic/surface_scenes.h"

#include <cmath>
#include <utility>

#include "synthetic/camera_rays.h"
#include "synthetic/scene_random.h"

namespace dominant_plane_detection {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr double kWide = 30.0;                     // [m] beyond what a camera sees
constexpr double kOnSurface = 2e-4;                // [m] rays are cast in single precision
constexpr double kMinFloor = 0.15;                 // [-] share of the image
constexpr double kMinOther = 0.02;                 // [-]
constexpr double kNearest = 0.5, kFarthest = 4.0;  // [m] of what counts

/// A scene in the making, and what is drawn about it.
class Drawing {
 public:
  explicit Drawing(SceneRandom& random) : random_(random) {
    result_.scene.camera = kinectCamera();
    KeyPose camera;
    camera.position.z() = random_.between(0.4, 2.0);
    ahead_ = random_.between(1.0, 2.5);
    camera.pitch = std::atan2(camera.position.z(), ahead_);
    camera.roll = random_.between(-10.0, 10.0) * kDegree;
    result_.scene.path.keys.push_back(camera);
    turn_ = random_.between(-0.4, 0.4);
  }

  SurfaceScene take() { return std::move(result_); }

  void floorKind(FloorKind kind) {
    switch (kind) {
      case FloorKind::kClean:
        floor();
        break;
      case FloorKind::kCluttered:
        floor();
        things(random_.count(4, 10), 0.05, 0.6);
        break;
      case FloorKind::kCut:
        cut();
        break;
      case FloorKind::kKerb:
        kerb();
        break;
      case FloorKind::kPlate:
        plate();
        break;
      case FloorKind::kSill:
        sill();
        break;
      case FloorKind::kRampUp:
        rampUp();
        break;
      case FloorKind::kRampDown:
        rampDown();
        break;
      case FloorKind::kStepDown:
        levels(-random_.between(0.03, 0.2));
        break;
      case FloorKind::kStairs:
        stairs();
        break;
      case FloorKind::kTwoLevels:
        levels(random_.between(0.02, 0.15));
        break;
      case FloorKind::kTable:
        table();
        break;
      case FloorKind::kLowObstacles:
        floor();
        things(random_.count(3, 8), 0.01, 0.05);
        break;
      case FloorKind::kRolled:
        rolled();
        break;
    }
  }

 private:
  /// Puts something at a place of the floor that is turned with the room.
  void place(TriangleMesh mesh, const Eigen::Vector3d& position, bool ground = false,
             double yaw = 0.0) {
    Eigen::Isometry3d pose(Eigen::AngleAxisd(turn_, Eigen::Vector3d::UnitZ()));
    pose.translate(position);
    pose.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    result_.scene.add(std::move(mesh), pose).ground = ground;
  }
  void surface(const Eigen::Vector3d& normal, double offset) {
    const Eigen::AngleAxisd turn(turn_, Eigen::Vector3d::UnitZ());
    result_.surfaces.push_back({turn * normal.normalized(), offset / normal.norm()});
  }
  void level(double height) { surface(Eigen::Vector3d::UnitZ(), height); }

  void floor() {
    place(rectangleMesh(kWide, kWide), {0.0, 0.0, 0.0}, true);
    level(0.0);
  }
  /// The floor up to a line across the view.
  void floorUpTo(double x) {
    place(rectangleMesh(kWide, kWide), {x - 0.5 * kWide, 0.0, 0.0}, true);
    level(0.0);
  }
  void things(int count, double lowest, double highest) {
    for (int i = 0; i < count; ++i) {
      const double x = random_.between(0.6, 1.6) * ahead_;
      const Eigen::Vector3d size(random_.between(0.08, 0.5), random_.between(0.08, 0.5),
                                 random_.between(lowest, highest));
      const Eigen::Vector3d position(x, random_.between(-0.6, 0.6) * x, 0.0);
      const bool round = random_.chance(0.4);
      place(round ? cylinderMesh(0.5 * size.x(), size.z()) : boxMesh(size), position, false,
            random_.between(-kPi, kPi));
    }
  }
  void cut() {
    floor();
    place(boxMesh({0.1, kWide, random_.between(0.08, 0.15)}), {ahead_, 0.0, 0.0});
  }
  void kerb() {
    floor();
    const double height = random_.between(0.03, 0.15), aside = random_.between(-0.3, 0.6);
    place(boxMesh({kWide, 0.5 * kWide, height}), {0.0, aside + 0.25 * kWide, 0.0});
    level(height);
  }
  void plate() {
    floor();
    const Eigen::Vector3d size(random_.between(0.5, 1.2), random_.between(0.5, 1.2),
                               random_.between(0.01, 0.04));
    place(boxMesh(size), {ahead_ * random_.between(0.8, 1.2), random_.between(-0.4, 0.4), 0.0});
    level(size.z());
  }
  void sill() {
    floor();
    const double height = random_.between(0.01, 0.04), depth = random_.between(0.04, 0.15);
    const double door = random_.between(0.8, 2.0), x = ahead_ * random_.between(0.8, 1.2);
    for (const double side : {-1.0, 1.0}) {
      place(boxMesh({0.1, kWide, 2.5}), {x, side * 0.5 * (door + kWide), 0.0});
    }
    place(boxMesh({depth, door, height}), {x, 0.0, 0.0});
  }
  void rampUp() {
    floor();
    const double slope = random_.between(2.0, 8.0) * kDegree, length = random_.between(0.8, 2.5);
    const double foot = ahead_ * random_.between(0.6, 1.0);
    place(rampMesh({length, random_.between(0.8, 2.0), length * std::tan(slope)}),
          {foot + 0.5 * length, random_.between(-0.5, 0.5), 0.0});
    surface({-std::sin(slope), 0.0, std::cos(slope)}, -foot * std::sin(slope));
  }
  void rampDown() {
    const double slope = random_.between(2.0, 8.0) * kDegree;
    const double top = ahead_ * random_.between(0.7, 1.1);
    floorUpTo(top);
    TriangleMesh ramp = rectangleMesh(kWide, kWide);
    Eigen::Isometry3d pose(Eigen::Translation3d(top, 0.0, 0.0));
    pose.rotate(Eigen::AngleAxisd(slope, Eigen::Vector3d::UnitY()));
    pose.translate(Eigen::Vector3d(0.5 * kWide, 0.0, 0.0));
    ramp.transform(pose);
    place(std::move(ramp), {0.0, 0.0, 0.0});
    surface({std::sin(slope), 0.0, std::cos(slope)}, top * std::sin(slope));
  }
  void levels(double step) {
    const double x = ahead_ * random_.between(0.7, 1.2);
    floorUpTo(x);
    if (step > 0.0) {
      place(boxMesh({kWide, kWide, step}), {x + 0.5 * kWide, 0.0, 0.0});
    } else {
      place(rectangleMesh(2.0 * kWide, kWide), {x, 0.0, step});
    }
    level(step);
  }
  void stairs() {
    const double rise = random_.between(0.12, 0.18), tread = random_.between(0.26, 0.32);
    const double first = ahead_ * random_.between(0.6, 1.0);
    const int count = random_.count(3, 5);
    if (random_.chance(0.5)) {
      floor();
      for (int i = 0; i < count; ++i) {
        const double length = i + 1 < count ? tread : kWide;
        place(boxMesh({length, 3.0, (i + 1) * rise}), {first + i * tread + 0.5 * length, 0.0, 0.0});
        level((i + 1) * rise);
      }
      return;
    }
    floorUpTo(first);
    for (int i = 0; i < count; ++i) {
      const double length = i + 1 < count ? tread : kWide;
      place(rectangleMesh(length, kWide), {first + i * tread + 0.5 * length, 0.0, -(i + 1) * rise});
      level(-(i + 1) * rise);
    }
  }
  void table() {
    floor();
    // Seen from above, low enough that the floor is within reach.
    KeyPose& camera = result_.scene.path.keys.front();
    camera.position.z() = random_.between(1.0, 2.0);
    camera.pitch = std::atan2(camera.position.z(), ahead_);
    const double height = camera.position.z() - random_.between(0.45, 0.9);
    const Eigen::Vector3d top(random_.between(0.4, 0.8), random_.between(0.6, 1.6), 0.03);
    const double x = 0.5 * top.x() + random_.between(0.2, 0.6);
    place(boxMesh(top), {x, random_.between(-0.4, 0.4), height - top.z()});
    level(height);
  }
  void rolled() {
    floor();
    things(random_.count(1, 4), 0.05, 0.4);
    result_.scene.path.keys.front().roll = (random_.chance(0.5) ? 30.0 : -30.0) * kDegree;
  }

  SceneRandom& random_;
  SurfaceScene result_;
  double ahead_ = 0.0;  ///< [m] where the optical axis meets the floor
  double turn_ = 0.0;   ///< [rad] of the room about the vertical
};

/// [rad] between the camera's up and the world's, at most; a little less than what the detector
/// takes for ground by default.
constexpr double kMaxTilt = 55.0 * kDegree;

bool isUpright(const SurfaceScene& scene) {
  const Eigen::Isometry3d pose = scene.scene.path.keys.front().pose();
  return -pose.linear()(2, 1) > std::cos(kMaxTilt);
}

bool showsEnough(const SurfaceScene& scene) {
  const Rendering rendering =
      Renderer(scene.scene).render(scene.scene.path.keys.front().pose(), {});
  const std::vector<int> shown = shownSurfaces(scene, rendering);
  std::vector<std::size_t> pixels(scene.surfaces.size(), 0);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto z = static_cast<double>(rendering.depth[i]);
    if (shown[i] >= 0 && z >= kNearest && z <= kFarthest) {
      ++pixels[static_cast<std::size_t>(shown[i])];
    }
  }
  const auto all = static_cast<double>(shown.size());
  const bool other = pixels.size() < 2 || static_cast<double>(pixels[1]) >= kMinOther * all;
  return other && static_cast<double>(pixels[0]) >= kMinFloor * all;
}

}  // namespace

const char* floorKindName(FloorKind kind) {
  static constexpr std::array<const char*, kFloorKinds.size()> kNames = {
      "clean",     "cluttered", "cut floor", "kerb",       "plate", "sill",          "ramp up",
      "ramp down", "step down", "stairs",    "two levels", "table", "low obstacles", "rolled"};
  return kNames[static_cast<std::size_t>(kind)];
}

SurfaceScene surfaceScene(FloorKind kind, std::uint32_t seed) {
  SceneRandom random(1000U * static_cast<std::uint32_t>(kind) + seed);
  while (true) {
    Drawing drawing(random);
    drawing.floorKind(kind);
    SurfaceScene scene = drawing.take();
    if (isUpright(scene) && showsEnough(scene)) return scene;
  }
}

std::vector<int> shownSurfaces(const SurfaceScene& scene, const Rendering& rendering) {
  const Eigen::Isometry3d pose = scene.scene.path.keys.front().pose();
  const std::vector<Eigen::Vector2f> rays = cameraRays(scene.scene.camera);
  std::vector<int> shown(rendering.depth.size(), -1);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto z = static_cast<double>(rendering.depth[i]);
    if (z <= 0.0) continue;
    const Eigen::Vector3d point = pose * (z * rays[i].cast<double>().homogeneous());
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
      const double off = scene.surfaces[s].normal.dot(point) - scene.surfaces[s].offset;
      if (std::abs(off) < kOnSurface * (1.0 + 0.1 * z * z)) shown[i] = static_cast<int>(s);
    }
  }
  return shown;
}

}  // namespace dominant_plane_detection
