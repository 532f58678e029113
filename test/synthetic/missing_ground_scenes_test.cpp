// Holes of known size in the floors of scenes, read with the errors of sensors.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/long_form.h"
#include "support/surface_figures.h"
#include "synthetic/camera_rays.h"

namespace dominant_plane_detection {
namespace {

constexpr double kSide = 0.2;                      // [m] of a hole
constexpr double kNearest = 0.6, kFarthest = 2.0;  // [m] of its middle

/// A floor as a camera sees it, and the truth.
struct Floor {
  explicit Floor(const SurfaceScene& scene)
      : rendering(Renderer(scene.scene)
                      .render(scene.scene.path.keys.front().pose(), {true, false, false})),
        shown(shownSurfaces(scene, rendering)),
        rays(cameraRays(scene.scene.camera)) {}

  /// @return [m] where a pixel's ray meets the plane of the floor; nothing where it does not.
  std::optional<Eigen::Vector3d> onFloor(std::size_t pixel) const {
    const Eigen::Vector3d ray = rays[pixel].cast<double>().homogeneous();
    const double slope = rendering.normal.dot(ray);
    if (slope > -0.02) return std::nullopt;
    return -rendering.distance / slope * ray;
  }
  /// @return the pixels whose rays meet a square of the floor; none where part of it is not seen.
  std::vector<std::size_t> square(const Eigen::Vector3d& middle, double turn) const {
    const Eigen::AngleAxisd about(turn, rendering.normal);
    const Eigen::Vector3d a = about * rendering.normal.unitOrthogonal();
    const Eigen::Vector3d b = rendering.normal.cross(a);
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const auto point = onFloor(i);
      if (!point) continue;
      const Eigen::Vector3d r = *point - middle;
      if (std::max(std::abs(r.dot(a)), std::abs(r.dot(b))) > 0.5 * kSide) continue;
      const auto u = static_cast<int>(i) % rendering.width,
                 v = static_cast<int>(i) / rendering.width;
      const bool at_border =
          u == 0 || v == 0 || u + 1 == rendering.width || v + 1 == rendering.height;
      if (shown[i] != 0 || at_border || rendering.shadow[i]) return {};
      pixels.push_back(i);
    }
    return pixels;
  }
  /// @return the pixels of a hole somewhere within 2 m; none where there is no room.
  std::vector<std::size_t> hole(std::uint32_t seed) const {
    std::mt19937 generator(seed);
    std::uniform_int_distribution<std::size_t> pixel(0, shown.size() - 1);
    std::uniform_real_distribution<double> turn(0.0, M_PI);
    for (int tries = 0; tries < 200; ++tries) {
      const std::size_t centre = pixel(generator);
      const auto middle = onFloor(centre);
      if (shown[centre] != 0 || !middle || middle->z() < kNearest || middle->z() > kFarthest)
        continue;
      const std::vector<std::size_t> pixels = square(*middle, turn(generator));
      if (!pixels.empty()) return pixels;
    }
    return {};
  }

  Rendering rendering;
  std::vector<int> shown;
  std::vector<Eigen::Vector2f> rays;
};

class Holes : public testing::TestWithParam<std::pair<FloorKind, ErrorKind>> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Holes,
                         testing::Values(std::make_pair(FloorKind::kClean, ErrorKind::kKinect),
                                         std::make_pair(FloorKind::kClean, ErrorKind::kRealsense),
                                         std::make_pair(FloorKind::kCluttered, ErrorKind::kSmooth),
                                         std::make_pair(FloorKind::kRolled, ErrorKind::kKinect)));

TEST_P(Holes, OfTwentyCentimetresAreToldWithinTwoMetres) {
  const auto& [kind, error] = GetParam();
  int holes = 0, told = 0;
  std::size_t wrong = 0, pixels = 0;
  const int wanted = longForm(25, 200);
  for (int seed = 1; holes < wanted; ++seed) {
    // Few have no room for a hole, or a floor that is not found.
    ASSERT_LT(seed, 2 * wanted) << holes;
    const auto number = static_cast<std::uint32_t>(seed);
    const SurfaceScene scene = surfaceScene(kind, number);
    const Floor floor(scene);
    const std::vector<std::size_t> hole = floor.hole(number);
    if (hole.empty()) continue;
    std::vector<std::uint16_t> depth = readDepth(floor.rendering, error, number);
    for (const std::size_t pixel : hole) depth[pixel] = 0;
    DominantPlaneDetector detector(parametersOf(error));
    const Detection& detection = detector.detect(
        {depth.data(), floor.rendering.width, floor.rendering.height}, scene.scene.camera);
    if (!detection.found() || detection.normal.dot(floor.rendering.normal) < 0.99) continue;
    ++holes;
    const auto is_missing = [&](std::size_t pixel) {
      return detection.labels[pixel] == static_cast<std::uint8_t>(Label::kMissingGround);
    };
    const auto in_hole =
        static_cast<std::size_t>(std::count_if(hole.begin(), hole.end(), is_missing));
    told += 2 * in_hole >= hole.size();
    std::size_t missing = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) missing += is_missing(i);
    wrong += missing - in_hole;
    pixels += depth.size();
  }
  // Those that are missed are in floors half of which was taken for another surface, or are next to
  // them: 6 of 200 with a Kinect's error and a camera that is rolled.
  EXPECT_GE(100 * told, longForm(90, 95) * holes) << told << " of " << holes;
  EXPECT_LE(static_cast<double>(wrong), 1e-4 * static_cast<double>(pixels));
  RecordProperty("told", told);
  RecordProperty("wrong_share",
                 std::to_string(static_cast<double>(wrong) / static_cast<double>(pixels)));
}

}  // namespace
}  // namespace dominant_plane_detection
