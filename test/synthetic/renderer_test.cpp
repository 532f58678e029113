#include "synthetic/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/ray_table.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {
namespace {

Scene bareFloor() {
  Scene scene;
  scene.camera = kinectCamera();
  SceneObject floor;
  floor.mesh = rectangleMesh(100.0, 100.0);
  floor.ground = true;
  scene.objects.push_back(floor);
  return scene;
}

KeyPose keyPose(double height, double pitch, double roll = 0.0) {
  KeyPose key;
  key.position.z() = height;
  key.pitch = pitch;
  key.roll = roll;
  return key;
}

void addBox(Scene& scene, const Eigen::Vector3d& size, const Eigen::Vector3d& position) {
  SceneObject box;
  box.mesh = boxMesh(size);
  box.mesh.transform(Eigen::Isometry3d(Eigen::Translation3d(position)));
  scene.objects.push_back(box);
}

Label labelAt(const Rendering& rendering, int u, int v) {
  return static_cast<Label>(rendering.labels[static_cast<std::size_t>(v * rendering.width + u)]);
}

float depthAt(const Rendering& rendering, int u, int v) {
  return rendering.depth[static_cast<std::size_t>(v * rendering.width + u)];
}

/// Depth of every pixel against the analytic plane of the pose.
void expectPlane(const Scene& scene, const KeyPose& key) {
  const Rendering rendering = Renderer(scene).render(key.pose(), {});
  RayTable rays;
  rays.build(scene.camera);
  std::size_t seen = 0;
  for (int v = 0; v < rendering.height; ++v) {
    for (int u = 0; u < rendering.width; ++u) {
      const auto z = static_cast<double>(depthAt(rendering, u, v));
      if (z <= 0.0 || z > 10.0) continue;
      ++seen;
      const double expected =
          -rendering.distance / rendering.normal.dot(rays.ray(u, v).cast<double>());
      ASSERT_NEAR(z, expected, 1e-4) << u << ", " << v;
      ASSERT_EQ(labelAt(rendering, u, v), Label::kGround);
    }
  }
  EXPECT_GT(seen, 100000U);
}

TEST(Renderer, FloorIsWhereThePoseSays) {
  expectPlane(bareFloor(), keyPose(0.5, 0.3));
  expectPlane(bareFloor(), keyPose(1.2, 0.8, 0.25));
  Scene distorted = bareFloor();
  distorted.camera.distortion = DistortionModel::kPlumbBob;
  distorted.camera.coefficients = {0.05, -0.1, 1e-3, -2e-3, 0.02};
  expectPlane(distorted, keyPose(0.8, 0.5, -0.2));
}

TEST(Renderer, TruePlaneOfAPose) {
  const Rendering level = Renderer(bareFloor()).render(keyPose(0.7, 0.0).pose(), {});
  EXPECT_LT((level.normal - Eigen::Vector3d(0.0, -1.0, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(level.distance, 0.7, 1e-12);
  const Rendering pitched = Renderer(bareFloor()).render(keyPose(0.7, 0.4).pose(), {});
  EXPECT_LT((pitched.normal - Eigen::Vector3d(0.0, -std::cos(0.4), -std::sin(0.4))).norm(), 1e-12);
}

TEST(Renderer, LabelsOfBoxAndHole) {
  Scene scene = bareFloor();
  addBox(scene, {0.3, 0.3, 0.2}, {1.5, 0.0, 0.0});
  const Rendering box = Renderer(scene).render(keyPose(0.8, 0.5).pose(), {});
  EXPECT_EQ(labelAt(box, 320, 230), Label::kObstacle);
  EXPECT_EQ(labelAt(box, 320, 470), Label::kGround);

  // The floor ends a metre ahead; another one lies 0.3 m below.
  Scene step;
  step.camera = kinectCamera();
  SceneObject near, below;
  near.mesh = rectangleMesh(20.0, 20.0);
  near.mesh.transform(Eigen::Isometry3d(Eigen::Translation3d(-9.0, 0.0, 0.0)));
  near.ground = true;
  below.mesh = rectangleMesh(100.0, 100.0);
  below.mesh.transform(Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.3)));
  step.objects = {near, below};
  const Rendering hole = Renderer(step).render(keyPose(0.8, 0.6).pose(), {});
  EXPECT_EQ(labelAt(hole, 320, 470), Label::kGround);
  EXPECT_EQ(labelAt(hole, 320, 100), Label::kDropOff);
}

TEST(SensorNoise, StandardDeviationIsTheModels) {
  Scene wall;
  wall.camera = kinectCamera();
  addBox(wall, {0.1, 50.0, 50.0}, {3.05, 0.0, -25.0});
  const Rendering rendering = Renderer(wall).render(keyPose(0.0, 0.0).pose(), {});
  SensorNoise noise = SensorNoise::none();
  noise.axial = true;
  noise.model = NoiseModel{};
  const auto readings = senseDepth(rendering, noise, 1);
  double sum = 0.0, sum_squares = 0.0;
  for (const std::uint16_t reading : readings) {
    const double error = reading / 1000.0 - 3.0;
    sum += error;
    sum_squares += error * error;
  }
  const auto n = static_cast<double>(readings.size());
  const double sigma = noise.model.sigma(3.0);
  EXPECT_NEAR(std::sqrt(sum_squares / n) / sigma, 1.0, 0.02);
  EXPECT_NEAR(sum / n, 0.0, 0.02 * sigma);
}

TEST(SensorNoise, QuantisationIsInDisparity) {
  SensorNoise noise = SensorNoise::none();
  const Scene scene = bareFloor();
  const Rendering rendering = Renderer(scene).render(keyPose(0.8, 0.4).pose(), {});
  noise.quantise = true;
  const auto readings = senseDepth(rendering, noise, 1);
  const double scale = scene.camera.fx * SensorNoise::kBaseline / SensorNoise::kDisparityStep;
  for (std::size_t i = 0; i < readings.size(); i += 97) {
    if (readings[i] == 0) continue;
    const double z = readings[i] / 1000.0;
    const double nearest = scale / std::round(scale / z);
    ASSERT_NEAR(z, nearest, 0.0006);  // rounded to mm
    ASSERT_NEAR(1.0 / z, 1.0 / static_cast<double>(rendering.depth[i]), 0.51 / scale + 0.001);
  }
}

TEST(SensorNoise, ShadowFallsToTheLeftOfAnObject) {
  Scene scene;
  scene.camera = kinectCamera();
  addBox(scene, {0.1, 50.0, 50.0}, {3.05, 0.0, -25.0});  // wall 3 m away
  addBox(scene, {0.1, 0.4, 0.4}, {1.55, 0.0, -0.2});     // box 1.5 m away
  const Rendering rendering = Renderer(scene).render(keyPose(0.0, 0.0).pose(), {true, true});
  SensorNoise noise = SensorNoise::none();
  noise.shadows = true;
  const auto readings = senseDepth(rendering, noise, 1);
  // The box covers 580 * 0.2 / 1.5 = 77 px to either side; its shadow is fx b (1/1.5 - 1/3) = 14.5
  // px.
  const auto reading = [&](int u) { return readings[static_cast<std::size_t>(240 * 640 + u)]; };
  EXPECT_GT(reading(319), 0);
  for (int u = 319 - 77 - 13; u < 319 - 79; ++u) EXPECT_EQ(reading(u), 0) << u;
  EXPECT_GT(reading(319 - 77 - 17), 0);
  EXPECT_GT(reading(319 + 77 + 4), 0);
}

TEST(SensorNoise, RangeDropOutAndGrazingGapsLeaveNoReading) {
  const Rendering rendering = Renderer(bareFloor()).render(keyPose(0.8, 0.3).pose(), {});
  SensorNoise noise = SensorNoise::none();
  noise.range_min = 1.5;
  noise.range_max = 3.0;
  for (const std::uint16_t reading : senseDepth(rendering, noise, 1)) {
    ASSERT_TRUE(reading == 0 || (reading >= 1500 && reading <= 3000));
  }
  noise = SensorNoise::none();
  noise.min_cosine = 0.4;  // of 0.8 m height: no floor beyond 2 m
  const auto readings = senseDepth(rendering, noise, 1);
  EXPECT_LT(*std::max_element(readings.begin(), readings.end()), 2100);
  noise = SensorNoise::none();
  const auto all = senseDepth(rendering, noise, 1);
  noise.drop_out = 0.25;
  const auto some = senseDepth(rendering, noise, 1);
  const auto lost = [](const auto& image) {
    return static_cast<double>(std::count(image.begin(), image.end(), 0));
  };
  const double kept = static_cast<double>(all.size()) - lost(all);
  EXPECT_NEAR((lost(some) - lost(all)) / kept, 0.25, 0.01);
}

TEST(SensorNoise, SmoothErrorIsSmoothAndOfItsSize) {
  // A wall at 2 m: every ray hits it at almost a right angle.
  Scene wall;
  wall.camera = kinectCamera();
  addBox(wall, {0.1, 50.0, 50.0}, {2.05, 0.0, -25.0});
  const Rendering rendering = Renderer(wall).render(keyPose(0.0, 0.0).pose(), {});
  SensorNoise noise = SensorNoise::none();
  noise.smooth = true;
  noise.octaves = {{16.0, 0.01, 0.0}, {16.0, 0.0, 0.02}};
  double sum_squares = 0.0, sum_steps = 0.0;
  double last = 0.0;
  const auto readings = senseDepth(rendering, noise, 4);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double error = readings[i] / 1000.0 - 2.0;
    sum_squares += error * error;
    if (i % 640 != 0) sum_steps += std::pow(error - last, 2);
    last = error;
  }
  // Two independent parts: 0.01 m, and 0.02 times 4 (a little more where the rays are slanted).
  const auto n = static_cast<double>(readings.size());
  const double size = std::hypot(0.01, 0.08);
  EXPECT_NEAR(std::sqrt(sum_squares / n) / size, 1.1, 0.15);
  EXPECT_LT(std::sqrt(sum_steps / n) / size, 0.15);
}

TEST(SensorNoise, SmoothErrorGrowsWithSlant) {
  // On the floor the error along the normal is quadratic * z^2 / cosine.
  const Rendering rendering = Renderer(bareFloor()).render(keyPose(0.8, 0.4).pose(), {});
  SensorNoise noise = SensorNoise::none();
  noise.smooth = true;
  noise.octaves = {{16.0, 0.0, 1e-3}};
  noise.range_max = 20.0;
  double sum_squares = 0.0, count = 0.0;
  const auto readings = senseDepth(rendering, noise, 5);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const auto z = static_cast<double>(rendering.depth[i]);
    const auto cosine = static_cast<double>(rendering.cosine[i]);
    if (z < 1.0 || z > 3.0) continue;
    const double along_normal = (readings[i] / 1000.0 - z) * cosine;
    sum_squares += std::pow(along_normal / (1e-3 * z * z / cosine), 2);
    ++count;
  }
  EXPECT_GT(count, 100000.0);
  EXPECT_NEAR(std::sqrt(sum_squares / count), 1.0, 0.15);
}

TEST(SensorNoise, SameNumberSameReadings) {
  const Rendering rendering = Renderer(bareFloor()).render(keyPose(0.8, 0.3).pose(), {true, true});
  const SensorNoise noise;
  EXPECT_EQ(senseDepth(rendering, noise, 3), senseDepth(rendering, noise, 3));
  EXPECT_NE(senseDepth(rendering, noise, 3), senseDepth(rendering, noise, 4));
}

TEST(CameraPath, PassesThroughItsKeysSmoothly) {
  CameraPath path;
  path.keys = {
      {0.0, {0, 0, 1}, 0, 0.2, 0}, {1.0, {1, 0, 1}, 0.1, 0.3, 0}, {3.0, {2, 1, 1}, 0, 0.1, 1}};
  for (const KeyPose& key : path.keys) {
    EXPECT_LT((path.at(key.time).position - key.position).norm(), 1e-12);
    EXPECT_NEAR(path.at(key.time).pitch, key.pitch, 1e-12);
  }
  EXPECT_EQ(path.duration(), 3.0);
  EXPECT_EQ(path.at(99.0).position, path.keys.back().position);
  const double before = (path.at(1.0).position - path.at(0.999).position).x();
  const double after = (path.at(1.001).position - path.at(1.0).position).x();
  EXPECT_NEAR(before, after, 1e-5);
}

}  // namespace
}  // namespace dominant_plane_detection
