// The scenes' noise against that of recordings, by the same measures.

#include "support/noise_figures.h"

#include <gtest/gtest.h>

#include "support/halves.h"
#include "synthetic_set.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// What the recordings of a sensor show, in depths of 0.75, 1.25, ... m; 0 where they have no
/// floor.
struct SensorFigures {
  const char* name;
  ReferenceSet (*recording)();
  SensorNoise noise;
  CameraModel camera;
  std::vector<KeyPose> poses;       ///< like the recording's
  std::array<double, 7> height;     ///< [mm]
  std::array<double, 7> neighbour;  ///< [mm]
  std::array<double, 7> local;      ///< [mm]
  double half_angle;                ///< [deg]
  double half_height;               ///< [mm]
};

KeyPose keyPose(double height, double pitch, double roll) {
  KeyPose key;
  key.position.z() = height;
  key.pitch = pitch;
  key.roll = roll;
  return key;
}

SensorFigures realsense() {
  SensorFigures figures;
  figures.name = "realsense";
  figures.recording = loadRobotLab;
  figures.noise = SensorNoise::realsense();
  figures.camera = kinectCamera();
  figures.camera.fx = figures.camera.fy = 383.8;
  figures.poses = {keyPose(0.63, 0.35, -0.17)};
  figures.height = {2.1, 3.3, 5.4, 9.4, 16.8, 27.0, 36.4};
  figures.neighbour = {0.37, 0.55, 0.81, 1.09, 1.49, 1.86, 2.21};
  figures.local = {1.6, 2.6, 4.4, 7.4, 10.9, 17.7, 24.8};
  figures.half_angle = 0.25;
  figures.half_height = 1.8;
  return figures;
}

SensorFigures kinect() {
  SensorFigures figures;
  figures.name = "kinect";
  figures.recording = loadCabinet;
  figures.camera = kinectCamera();
  figures.camera.fx = figures.camera.fy = 537.0;
  figures.poses = {keyPose(1.08, 0.72, 0.01), keyPose(1.06, 0.71, 0.09), keyPose(1.03, 0.68, 0.12)};
  figures.height = {0.0, 3.7, 5.3, 8.6, 12.7, 16.9, 0.0};
  figures.neighbour = {0.0, 0.18, 0.26, 0.33, 0.38, 0.47, 0.0};
  figures.local = {0.0, 2.1, 2.7, 4.0, 5.9, 7.6, 0.0};
  figures.half_angle = 0.84;
  figures.half_height = 9.8;
  return figures;
}

class SensorFiguresTest : public testing::TestWithParam<SensorFigures> {
 protected:
  /// A bare floor from the recording's poses.
  static ReferenceSet floors(std::uint32_t count) {
    Scene scene;
    scene.camera = GetParam().camera;
    SceneObject floor;
    floor.mesh = rectangleMesh(40.0, 40.0);
    floor.ground = true;
    scene.objects.push_back(floor);
    ReferenceSet set;
    set.camera = scene.camera;
    for (std::uint32_t frame = 0; frame < count; ++frame) {
      scene.path.keys = {GetParam().poses[frame % GetParam().poses.size()]};
      set.images.push_back(senseScene(scene, GetParam().noise, frame));
    }
    return set;
  }
  /// @param share [-] by which a figure may be off.
  static void expectFigures(const ReferenceSet& set, double share) {
    const auto figures = noiseFigures(set);
    for (std::size_t i = 0; i < figures.size(); ++i) {
      if (GetParam().height[i] == 0.0) continue;
      const auto expectNear = [&](double value, double expected, const char* what) {
        EXPECT_NEAR(1e3 * value, expected, share * expected)
            << what << " at " << figures[i].nearest << " m";
      };
      expectNear(figures[i].height, GetParam().height[i], "height");
      expectNear(figures[i].neighbour, GetParam().neighbour[i], "neighbour");
      expectNear(figures[i].local, GetParam().local[i], "local");
    }
  }
  static void expectHalves(const ReferenceSet& set, double share) {
    const HalvesSummary halves = compareHalves(set, Algorithm::kGrid);
    EXPECT_EQ(halves.found, halves.images);
    EXPECT_NEAR(halves.angle / kDegree, GetParam().half_angle, share * GetParam().half_angle);
    EXPECT_NEAR(1e3 * halves.height, GetParam().half_height, share * GetParam().half_height);
  }
};

TEST_P(SensorFiguresTest, RecordingHasThem) {
  const ReferenceSet set = GetParam().recording();
  if (set.images.empty()) {
    GTEST_SKIP() << "no recordings in " << recordingsFolder() << "; set DPD_RECORDINGS";
  }
  expectFigures(set, 0.03);
  expectHalves(set, 0.1);
}

TEST_P(SensorFiguresTest, SceneHasThem) {
  expectFigures(floors(24), 0.3);
  expectHalves(floors(200), 0.3);
}

INSTANTIATE_TEST_SUITE_P(Sensors, SensorFiguresTest, testing::Values(realsense(), kinect()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace dominant_plane_detection
