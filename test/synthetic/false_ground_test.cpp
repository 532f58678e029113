// Images without ground, and planes that are no surface.

#include <gtest/gtest.h>

#include <algorithm>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/long_form.h"
#include "support/recordings.h"
#include "synthetic/ground_scenes.h"
#include "synthetic/groundless_scene.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;

Rendering seen(const Scene& scene) {
  return Renderer(scene).render(scene.path.keys.front().pose(), {true, false});
}

/// Ceilings, floors on their head, walls, corners, steep tables, people, balls and curtains.
TEST(FalseGround, NoneInScenesWithoutGround) {
  DominantPlaneDetector detector;
  const auto scenes = static_cast<std::uint32_t>(longForm(64, 504));
  for (std::uint32_t seed = 1; seed <= scenes; ++seed) {
    const Scene scene = groundlessScene(seed);
    for (const SensorNoise& noise : {SensorNoise(), SensorNoise::independent()}) {
      const std::vector<std::uint16_t> readings = senseDepth(seen(scene), noise, seed);
      const Detection& detection =
          detector.detect({readings.data(), scene.camera.width, scene.camera.height}, scene.camera);
      EXPECT_FALSE(detection.found())
          << "scene " << seed << ": " << detection.inliers << " of " << detection.valid_pixels;
      EXPECT_FALSE(detection.reason.empty());
    }
  }
}

std::size_t countFound(const ReferenceSet& set, const CameraModel& camera,
                       const std::vector<cv::Mat>& images) {
  Parameters parameters;
  parameters.range_min = set.range_min;
  DominantPlaneDetector detector(parameters);
  std::size_t found = 0;
  for (const cv::Mat& depth : images) {
    found += detector
                 .detect({depth.ptr<std::uint16_t>(), depth.cols, depth.rows, set.metres_per_unit},
                         camera)
                 .found();
  }
  return found;
}

/// A floor that is a ceiling, as up stays where it was. The camera looks ahead, so that walls stay
/// walls, and nothing in the recording is flat from below.
TEST(FalseGround, NoneInARecordingOnItsHead) {
  const ReferenceSet set = loadRobotLab();
  if (set.images.empty()) GTEST_SKIP() << "no recordings in " << recordingsFolder();
  CameraModel camera = set.camera;
  camera.cx = camera.width - 1 - camera.cx;
  camera.cy = camera.height - 1 - camera.cy;
  std::vector<cv::Mat> turned;
  for (const ReferenceImage& image : set.images) {
    turned.push_back(image.depth.clone());
    std::reverse(turned.back().begin<std::uint16_t>(), turned.back().end<std::uint16_t>());
  }
  EXPECT_EQ(countFound(set, camera, turned), 0U);
}

/// Walls, boxes and chairs, each horizontal face too small, after all readings within 3 cm and five
/// standard deviations of the floor were taken away.
TEST(FalseGround, NoneInARecordingWithoutItsFloor) {
  const ReferenceSet set = loadLowRobot();
  if (set.images.empty()) GTEST_SKIP() << "no recordings in " << recordingsFolder();
  const NoiseModel noise;
  std::vector<cv::Mat> rest;
  for (const ReferenceImage& image : set.images) {
    rest.push_back(image.depth.clone());
    for (int v = 0; v < image.depth.rows; ++v) {
      for (int u = 0; u < image.depth.cols; ++u) {
        const double z = static_cast<double>(metresAt(set.view(image), u, v));
        const Eigen::Vector2d ray = set.camera.ray({u, v});
        const double height =
            z * image.up.dot(Eigen::Vector3d(ray.x(), ray.y(), 1.0)) + image.height;
        const bool floor = std::abs(height) < std::max(0.03, 5.0 * noise.sigma(z));
        if (floor) rest.back().at<std::uint16_t>(v, u) = 0;
      }
    }
  }
  EXPECT_EQ(countFound(set, set.camera, rest), 0U);
}

/// What two levels make of a plane between them: it has to lie on either.
struct Levels {
  std::string name;
  Scene scene;
  double step;  ///< [m] the other level over the floor
};

std::vector<Levels> levels() {
  std::vector<Levels> all;
  for (const double step : {0.015, 0.02, 0.025, 0.03, 0.04}) {
    for (const double ahead : {0.8, 0.9, 1.0}) {
      all.push_back({"plate", plateScene(step, ahead), step});
    }
  }
  for (const double step : {0.015, 0.02, 0.03, 0.05, -0.02, -0.04}) {
    for (const double ahead : {1.0, 1.5, 2.0}) {
      all.push_back({"two levels", twoLevelScene(step, ahead), step});
    }
  }
  return all;
}

TEST(FalseGround, NoPlaneBetweenTwoLevels) {
  const int runs = longForm(10, 30);
  for (const Levels& level : levels()) {
    const Rendering rendering = seen(level.scene);
    for (int run = 0; run < runs; ++run) {
      Parameters parameters;
      parameters.random_seed = run;
      DominantPlaneDetector detector(parameters);
      const std::vector<std::uint16_t> readings =
          senseDepth(rendering, SensorNoise::independent(), static_cast<std::uint32_t>(run + 1));
      const Detection& detection =
          detector.detect({readings.data(), rendering.width, rendering.height}, level.scene.camera);
      ASSERT_TRUE(detection.found()) << level.name << " " << level.step;
      const double angle = std::acos(std::min(detection.normal.dot(rendering.normal), 1.0));
      const double over = rendering.distance - detection.distance;  // the plane over the floor
      const double off = std::min(std::abs(over), std::abs(over - level.step));
      EXPECT_LT(angle, 0.3 * kDegree) << level.name << " " << level.step << " run " << run;
      EXPECT_LT(off, 0.005) << level.name << " " << level.step << " run " << run;
      // The floor has three times the plate's pixels.
      if (level.name == "plate") {
        EXPECT_LT(std::abs(over), 0.005) << level.step << " run " << run;
      }
    }
  }
}

}  // namespace
}  // namespace dominant_plane_detection
