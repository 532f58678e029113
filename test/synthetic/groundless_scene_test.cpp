#include "synthetic/groundless_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "dominant_plane_detection/camera_model.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;

Layers withNormals() {
  Layers layers;
  layers.surface_normals = true;
  return layers;
}

Rendering seen(const Scene& scene) {
  return Renderer(scene).render(scene.path.keys.front().pose(), withNormals());
}

/// A plane, seen in the whole image at about 2 m, whose normal is `tilt` from up.
Scene tiltedPlane(double tilt) {
  Scene scene;
  scene.camera = kinectCamera();
  SceneObject plane;
  plane.mesh = rectangleMesh(50.0, 50.0);
  plane.mesh.transform(Eigen::Translation3d(2.0, 0.0, 0.0) *
                       Eigen::AngleAxisd(-tilt, Eigen::Vector3d::UnitY()));
  scene.objects.push_back(plane);
  scene.path.keys.emplace_back();
  return scene;
}

/// Normals by differences of the depth image, an independent way to them.
TEST(SurfaceNormals, AreThoseOfTheDepthImage) {
  for (const std::uint32_t seed : {1U, 3U, 6U, 7U}) {
    const Scene scene = groundlessScene(seed);
    const CameraModel& camera = scene.camera;
    const Rendering rendering = seen(scene);
    const auto at = [&](int u, int v) { return static_cast<std::size_t>(v * camera.width + u); };
    const auto point = [&](int u, int v) {
      const auto z = static_cast<double>(rendering.depth[at(u, v)]);
      return Eigen::Vector3d((u - camera.cx) / camera.fx * z, (v - camera.cy) / camera.fy * z, z);
    };
    std::size_t compared = 0, agreeing = 0;
    for (int v = 1; v + 1 < camera.height; v += 3) {
      for (int u = 1; u + 1 < camera.width; u += 3) {
        if (rendering.depth[at(u, v)] <= 0.0F) continue;
        const Eigen::Vector3d normal =
            (point(u, v + 1) - point(u, v - 1)).cross(point(u + 1, v) - point(u - 1, v));
        const Eigen::Vector3d exact = rendering.surface_normals[at(u, v)].cast<double>();
        ASSERT_NEAR(exact.norm(), 1.0, 1e-5);
        ASSERT_LT(exact.dot(point(u, v)), 0.0);
        ++compared;
        agreeing += normal.normalized().dot(exact) > std::cos(6.0 * kDegree);
      }
    }
    EXPECT_GT(compared, 5000U);
    EXPECT_GT(static_cast<double>(agreeing), 0.9 * static_cast<double>(compared)) << seed;
  }
}

TEST(GroundlessScene, ShareCountsPlanesWithin75DegreesOfUp) {
  EXPECT_GT(largestGroundShare(seen(tiltedPlane(40.0 * kDegree))), 0.99);
  EXPECT_GT(largestGroundShare(seen(tiltedPlane(74.0 * kDegree))), 0.99);
  EXPECT_EQ(largestGroundShare(seen(tiltedPlane(76.0 * kDegree))), 0.0);
  EXPECT_EQ(largestGroundShare(seen(tiltedPlane(110.0 * kDegree))), 0.0);
  EXPECT_TRUE(std::isnan(largestGroundShare(seen(tiltedPlane(180.0 * kDegree)))));
}

TEST(GroundlessScene, NoPlaneForGroundInSight) {
  std::map<GroundlessKind, int> kinds;
  for (std::uint32_t seed = 0; seed < 48; ++seed) {
    ++kinds[groundlessKind(seed)];
    const Rendering rendering = seen(groundlessScene(seed));
    // No direction within 75 degrees of up has 5 % of the pixels about it: looked for by each
    // pixel's own normal, where the function goes through a grid of directions.
    std::vector<Eigen::Vector3f> upward;
    std::size_t valid = 0;
    for (std::size_t i = 0; i < rendering.depth.size(); i += 7) {
      if (rendering.depth[i] < 0.5F || rendering.depth[i] > 4.0F) continue;
      ++valid;
      if (-rendering.surface_normals[i].y() > std::cos(75.0F * 0.0174533F)) {
        upward.push_back(rendering.surface_normals[i]);
      }
    }
    EXPECT_GT(valid * 7, 30000U) << seed;
    for (std::size_t i = 0; i < upward.size(); i += 20) {
      std::size_t alike = 0;
      for (const Eigen::Vector3f& other : upward)
        alike += other.dot(upward[i]) > 0.99756F;  // 4 deg
      ASSERT_LT(static_cast<double>(alike), 0.05 * static_cast<double>(valid)) << seed;
    }
  }
  EXPECT_EQ(kinds.size(), kGroundlessKinds);
}

TEST(GroundlessScene, SameSeedSameScene) {
  for (std::uint32_t seed = 0; seed < kGroundlessKinds; ++seed) {
    const Rendering once = seen(groundlessScene(seed)), again = seen(groundlessScene(seed));
    EXPECT_EQ(once.depth, again.depth);
    EXPECT_NE(once.depth, seen(groundlessScene(seed + kGroundlessKinds)).depth);
  }
}

TEST(GroundlessScene, SteepTablesAreSteep) {
  for (std::uint32_t i = 0; i < 6; ++i) {
    const Scene scene = groundlessScene(i * kGroundlessKinds +
                                        static_cast<std::uint32_t>(GroundlessKind::kSteepTable));
    const Rendering rendering = seen(scene);
    std::size_t steep = 0;
    for (const Eigen::Vector3f& normal : rendering.surface_normals) {
      steep += -normal.y() > std::cos(100.0F * 0.0174533F) &&
               -normal.y() < std::cos(75.0F * 0.0174533F) && normal.squaredNorm() > 0.5F;
    }
    EXPECT_GT(steep, 20000U);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
