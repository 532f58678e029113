// The planes of rooms against their exact truth.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/long_form.h"
#include "synthetic/camera_rays.h"
#include "synthetic/renderer.h"
#include "synthetic/room_scene.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;

struct TruePlane {
  Eigen::Vector3d normal;  ///< [-] towards the camera, in the optical frame
  double distance;         ///< [m]
  PlaneKind kind;
  std::size_t pixels;  ///< [px] with readings between 0.5 and 4 m

  double share() const { return static_cast<double>(pixels) / (640 * 480); }  ///< [-]
};

/// @return what a plane of the world is, by its upward normal and height.
PlaneKind trueKind(const Eigen::Vector3d& normal, double height) {
  if (normal.z() < std::cos(45.0 * kDegree)) return PlaneKind::kWall;
  if (normal.z() < std::cos(1.0 * kDegree)) return PlaneKind::kRamp;
  if (std::abs(height) < 0.001) return PlaneKind::kFloor;
  return height <= 0.35 ? PlaneKind::kStep : PlaneKind::kTable;
}

/// @return the planes of a rendering: all its readings with the same normal and distance.
std::vector<TruePlane> truePlanes(const Scene& scene, const Rendering& rendering,
                                  const std::vector<std::uint16_t>& depth) {
  const Eigen::Isometry3d pose = scene.path.keys.front().pose();
  const std::vector<Eigen::Vector2f> rays = cameraRays(scene.camera);
  std::vector<TruePlane> planes;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto z = static_cast<double>(rendering.depth[i]);
    if (z < 0.5 || z > 4.0 || depth[i] == 0) continue;
    const Eigen::Vector3d normal = rendering.surface_normals[i].cast<double>().normalized();
    const Eigen::Vector3d point = z * rays[i].cast<double>().homogeneous();
    const double distance = -normal.dot(point);
    const auto same = std::find_if(planes.begin(), planes.end(), [&](const TruePlane& plane) {
      return plane.normal.dot(normal) > 1.0 - 1e-5 && std::abs(plane.distance - distance) < 0.003;
    });
    if (same != planes.end()) {
      ++same->pixels;
    } else {
      planes.push_back({normal, distance, trueKind(pose.linear() * normal, (pose * point).z()), 1});
    }
  }
  return planes;
}

bool isNear(const FurtherPlane& found, const TruePlane& truth, double angle, double distance) {
  return found.normal.dot(truth.normal) > std::cos(angle) &&
         std::abs(found.distance - truth.distance) < distance;
}

struct Figures {
  int truths = 0, found = 0, right_kind = 0;  ///< [#] planes of 3 % of the pixels or more
  int told = 0, real = 0;                     ///< [#] planes that were told, and that there are
};

/// Errors, and what a plane may be off by.
struct Case {
  const char* name;
  SensorNoise noise;
  double angle;     ///< [rad]
  double distance;  ///< [m]
  double found;     ///< [-] share at least
  double real;      ///< [-] share at least
};

void add(const Detection& detection, const std::vector<TruePlane>& planes, const Case& allowed,
         Figures& figures) {
  for (const TruePlane& truth : planes) {
    if (truth.kind == PlaneKind::kFloor || truth.share() < 0.03) continue;
    ++figures.truths;
    for (const FurtherPlane& plane : detection.further_planes) {
      if (!isNear(plane, truth, allowed.angle, allowed.distance)) continue;
      ++figures.found;
      figures.right_kind += plane.kind == truth.kind;
      break;
    }
  }
  for (const FurtherPlane& plane : detection.further_planes) {
    ++figures.told;
    figures.real += std::any_of(planes.begin(), planes.end(), [&](const TruePlane& truth) {
      return truth.share() > 0.01 && isNear(plane, truth, allowed.angle, allowed.distance);
    });
  }
}

class Rooms : public testing::TestWithParam<Case> {};

// A wall 3 m away is off by more than 1 degree and 10 mm if its readings are by a sensor's smooth
// error.
INSTANTIATE_TEST_SUITE_P(
    Errors, Rooms,
    testing::Values(Case{"none", SensorNoise::none(), 1.0 * kDegree, 0.010, 0.95, 0.98},
                    Case{"independent", SensorNoise::independent(), 1.0 * kDegree, 0.010, 0.93,
                         0.95},
                    Case{"RealSense", SensorNoise::realsense(), 2.0 * kDegree, 0.030, 0.93, 0.95},
                    Case{"Kinect", SensorNoise(), 3.0 * kDegree, 0.050, 0.90, 0.93}),
    [](const auto& test) { return std::string(test.param.name); });

TEST_P(Rooms, HaveTheirPlanesToldByKind) {
  Parameters parameters;
  parameters.max_planes = 12;
  DominantPlaneDetector detector(parameters);
  Figures figures;
  for (int seed = 1; seed <= longForm(20, 100); ++seed) {
    const auto number = static_cast<std::uint32_t>(seed);
    const Scene scene = roomScene(number);
    const Rendering rendering =
        Renderer(scene).render(scene.path.keys.front().pose(), {true, false, true});
    const std::vector<std::uint16_t> depth = senseDepth(rendering, GetParam().noise, number);
    Prior prior;
    prior.height_range = Prior::HeightRange{rendering.distance - 0.03, rendering.distance + 0.03};
    const Detection& detection =
        detector.detect({depth.data(), rendering.width, rendering.height}, scene.camera, prior);
    // Kinds are told against the floor.
    if (!detection.found() || detection.normal.dot(rendering.normal) < std::cos(3.0 * kDegree)) {
      continue;
    }
    add(detection, truePlanes(scene, rendering, depth), GetParam(), figures);
  }
  RecordProperty("truths", figures.truths);
  RecordProperty("found", figures.found);
  RecordProperty("right_kind", figures.right_kind);
  RecordProperty("told", figures.told);
  RecordProperty("real", figures.real);
  // Some planes more or less count for much among few.
  const double slack = 0.01 * longForm(5, 0);
  EXPECT_GE(figures.truths, longForm(40, 200));
  EXPECT_GE(figures.found, (GetParam().found - slack) * figures.truths) << "of " << figures.truths;
  EXPECT_GE(figures.right_kind, 0.99 * figures.found) << "of " << figures.found;
  EXPECT_GE(figures.real, (GetParam().real - slack) * figures.told) << "of " << figures.told;
}

}  // namespace
}  // namespace dominant_plane_detection
