#include "synthetic/ground_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "dominant_plane_detection/detection.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {
namespace {

struct SeenPoint {
  Eigen::Vector3d position;  ///< [m] in the world
  Label label;
};

/// What the scene's camera sees within 4 m, by the pinhole and the pitch alone.
std::vector<SeenPoint> seenPoints(const Scene& scene) {
  const KeyPose& key = scene.path.keys.front();
  const CameraModel& camera = scene.camera;
  const Rendering rendering = Renderer(scene).render(key.pose(), {});
  const double c = std::cos(key.pitch), s = std::sin(key.pitch);
  std::vector<SeenPoint> points;
  for (int v = 0; v < rendering.height; ++v) {
    for (int u = 0; u < rendering.width; ++u) {
      const auto i = static_cast<std::size_t>(v * rendering.width + u);
      const auto z = static_cast<double>(rendering.depth[i]);
      if (z <= 0.0 || z > 4.0) continue;
      const double right = (u - camera.cx) / camera.fx * z, down = (v - camera.cy) / camera.fy * z;
      points.push_back({{z * c - down * s, -right, key.position.z() - down * c - z * s},
                        static_cast<Label>(rendering.labels[i])});
    }
  }
  return points;
}

/// The height of what lies at (x, y), the top where it is a step.
using HeightMap = std::function<double(double x, double y)>;

/// Every point lies on the map, but for a centimetre about its steps; what is not as high as the
/// ground is not labelled ground.
/// @param raised [px] of points above or below the ground, at least.
void expectHeights(const Scene& scene, const HeightMap& height, std::size_t raised) {
  std::size_t ground = 0, others = 0;
  for (const SeenPoint& point : seenPoints(scene)) {
    const double x = point.position.x(), y = point.position.y();
    const double h = height(x, y);
    const auto stepAt = [&](double dx, double dy) {
      return std::abs(height(x + dx, y + dy) - h) > 0.005;
    };
    if (stepAt(0.01, 0) || stepAt(-0.01, 0) || stepAt(0, 0.01) || stepAt(0, -0.01)) continue;
    ASSERT_NEAR(point.position.z(), h, 2e-5) << x << ", " << y;
    const Label expected = h == 0.0 ? Label::kGround : h > 0.0 ? Label::kObstacle : Label::kDropOff;
    ASSERT_EQ(point.label, expected) << x << ", " << y;
    (h == 0.0 ? ground : others) += 1;
  }
  EXPECT_GT(ground, 50000U);
  EXPECT_GT(others, raised);
}

TEST(GroundScenes, Plate) {
  for (const double ahead : {0.8, 1.0}) {
    const auto on_plate = [&](double x, double y) {
      return x >= ahead && x <= ahead + 0.8 && std::abs(y) <= 0.4;
    };
    expectHeights(
        plateScene(0.03, ahead), [&](double x, double y) { return on_plate(x, y) ? 0.03 : 0.0; },
        30000);
    EXPECT_EQ(plateScene(0.03, ahead).path.keys.front().position.z(), 0.6);
  }
}

TEST(GroundScenes, Kerb) {
  expectHeights(
      kerbScene(0.12, 0.4), [](double, double y) { return y >= 0.4 ? 0.12 : 0.0; }, 30000);
}

TEST(GroundScenes, Ramp) {
  const auto height = [](double x, double y) {
    return x >= 1.0 && x <= 2.2 && std::abs(y) <= 0.6 ? (x - 1.0) * std::tan(0.15) : 0.0;
  };
  expectHeights(rampScene(0.15, 1.0), height, 50000);
}

TEST(GroundScenes, TwoLevels) {
  for (const double step : {0.15, -0.15}) {
    expectHeights(
        twoLevelScene(step, 1.2), [&](double x, double) { return x >= 1.2 ? step : 0.0; }, 50000);
  }
}

TEST(GroundScenes, DoorSill) {
  std::size_t sill = 0, behind = 0;
  for (const SeenPoint& point : seenPoints(doorSillScene(0.025, 1.0))) {
    const Eigen::Vector3d& p = point.position;
    if (point.label == Label::kGround) {
      ASSERT_NEAR(p.z(), 0.0, 2e-5);
      behind += p.x() > 1.1;
      continue;
    }
    const bool of_wall = std::abs(p.y()) > 0.45 - 1e-4;
    ASSERT_TRUE(of_wall || p.z() <= 0.025 + 2e-5) << p.transpose();
    ASSERT_TRUE(p.x() >= 1.0 - 1e-4 && p.x() <= 1.1 + 1e-4) << p.transpose();
    sill += !of_wall && p.z() > 0.025 - 2e-5;
  }
  EXPECT_GT(sill, 5000U);
  EXPECT_GT(behind, 20000U);
}

TEST(GroundScenes, Table) {
  for (const double ahead : {0.3, 1.0}) {
    const Scene scene = tableScene(0.74, ahead);
    EXPECT_DOUBLE_EQ(scene.path.keys.front().position.z(), 1.24);
    std::size_t top = 0, ground = 0;
    for (const SeenPoint& point : seenPoints(scene)) {
      const Eigen::Vector3d& p = point.position;
      ASSERT_LE(p.z(), 0.74 + 2e-5);
      if (point.label == Label::kGround) {
        ASSERT_NEAR(p.z(), 0.0, 2e-5);
        ++ground;
        continue;
      }
      ASSERT_TRUE(p.x() >= ahead - 1e-4 && p.x() <= ahead + 0.8 + 1e-4) << p.transpose();
      ASSERT_LE(std::abs(p.y()), 0.8 + 1e-4);
      top += p.z() > 0.74 - 2e-5;
    }
    // Near, the top fills most of the image; farther off, the floor does.
    EXPECT_EQ(top > ground, ahead < 0.5);
    EXPECT_GT(std::min(top, ground), 30000U);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
