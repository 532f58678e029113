#include "synthetic/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

#include "dominant_plane_detection/detection.h"
#include "synthetic/random_scene.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {
namespace {

double groundShare(const Scene& scene, const KeyPose& key) {
  const Rendering rendering = Renderer(scene).render(key.pose(), {});
  const auto ground = std::count(rendering.labels.begin(), rendering.labels.end(),
                                 static_cast<std::uint8_t>(Label::kGround));
  return static_cast<double>(ground) / static_cast<double>(rendering.labels.size());
}

class ShippedScene : public testing::TestWithParam<const char*> {};

TEST_P(ShippedScene, ShowsTheFloorAllTheWay) {
  const Scene scene = loadScene(std::string(DPD_SCENES) + "/" + GetParam());
  EXPECT_GE(scene.path.duration(), 10.0);
  for (double time = 0.0; time <= scene.path.duration(); time += 0.5) {
    EXPECT_GT(groundShare(scene, scene.path.at(time)), 0.3) << "at " << time << " s";
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene,
                         testing::Values("rubbish_bin.yaml", "laboratory.yaml", "plate.yaml",
                                         "kerb.yaml", "ramp.yaml", "two_levels.yaml",
                                         "door_sill.yaml", "table.yaml"));

class SceneFile : public testing::Test {
 protected:
  ~SceneFile() override {
    std::remove(file_.c_str());
    std::remove(object_file_.c_str());
  }
  std::string errorOf(const std::string& yaml) {
    std::ofstream(file_) << yaml;
    try {
      loadScene(file_);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }
  const std::string file_ = testing::TempDir() + "scene_test.yaml";
  const std::string object_file_ = testing::TempDir() + "scene_test.obj";
};

constexpr const char* kPath = "path: [{time: 0, position: [0, 0, 1]}]\n";

TEST_F(SceneFile, EveryShapeAndSetting) {
  std::ofstream(object_file_) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_EQ(
      errorOf(std::string(kPath) +
              "camera: {width: 320, height: 240, fx: 290, fy: 290, cx: 159.5, cy: 119.5}\n"
              "noise: {sensor: realsense, axial: false, noise_quadratic: 0.002, drop_out: 0.1}\n"
              "objects:\n"
              "  - {shape: floor, ground: true, size: [10, 8], tiles: 0.5}\n"
              "  - {shape: ramp, size: [1, 1, 0.2], position: [2, 0, 0], yaw: 0.3}\n"
              "  - {shape: step, size: [1, 1, 0.15], position: [3, 0, 0]}\n"
              "  - {shape: wall, size: [0.1, 5, 2], position: [5, 0, 0]}\n"
              "  - {shape: box, size: [1, 1, 1], colour: [1, 0, 0]}\n"
              "  - {shape: cylinder, radius: 0.2, height: 1}\n"
              "  - {shape: mesh, file: scene_test.obj}\n"),
      "");
  const Scene scene = loadScene(file_);
  ASSERT_EQ(scene.objects.size(), 7U);
  EXPECT_TRUE(scene.objects[0].ground);
  EXPECT_EQ(scene.objects[6].mesh.triangles.size(), 1U);
  EXPECT_EQ(scene.camera.width, 320);
  EXPECT_FALSE(scene.noise.axial);
  EXPECT_TRUE(scene.noise.smooth);
  EXPECT_FALSE(scene.noise.quantise);  // a RealSense's
  EXPECT_EQ(scene.noise.drop_out, 0.1);
}

TEST_F(SceneFile, ErrorsNameFileLineAndKey) {
  const auto expectError = [&](const std::string& yaml, const char* line, const char* words) {
    const std::string error = errorOf(yaml);
    EXPECT_NE(error.find(file_), std::string::npos) << error;
    EXPECT_NE(error.find(line), std::string::npos) << error;
    EXPECT_NE(error.find(words), std::string::npos) << error;
  };
  const std::string path = kPath;
  expectError(path + "objects:\n  - {shape: box, size: [1, 1, 1], color: [1, 1, 1]}\n", "line 3",
              "'color'");
  expectError(path + "objects:\n  - {shape: sphere}\n", "line 3", "'sphere'");
  expectError(path + "objects:\n  - {shape: box, size: [1, 1]}\n", "line 3", "'size'");
  expectError(path + "objects:\n  - {shape: cylinder, radius: wide, height: 1}\n", "line 3",
              "'radius'");
  expectError(path + "objects:\n  - {shape: mesh, file: nothing.obj}\n", "", "nothing.obj");
  expectError(path + "noise: {sensor: sonar}\nobjects: [{shape: floor}]\n", "line 2", "'sonar'");
  expectError("objects: [{shape: floor}]\n", "line 1", "'path'");
  expectError(path, "line 1", "'objects'");
  expectError(path + "objects: [\n", "line", "");
}

TEST(RandomScene, KeepsItsPromises) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = randomScene(seed);
    const KeyPose key = scene.path.keys.front();
    EXPECT_GE(key.position.z(), 0.3);
    EXPECT_LE(key.position.z(), 1.5);
    EXPECT_GE(key.pitch, 0.174);
    EXPECT_LE(key.pitch, 0.873);
    EXPECT_LE(std::abs(key.roll), 0.262);
    EXPECT_GE(groundShare(scene, key), 0.08);
    const std::size_t cut = seed % 3 == 0 ? 1 : 0;
    EXPECT_GE(scene.objects.size(), 6 + cut);
    EXPECT_LE(scene.objects.size(), 12 + cut);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
