// The search for the dominant plane by Algorithm 1: which regions are grown, and at what cost.

#include "core/kdtree_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr std::size_t kPoints = kWidth * kHeight / 4;  // at a subsampling of 2
const Eigen::Vector3d kUp(0.0, -1.0, 0.0);

using Image = OwnedDepth<float>;

Image draw(const std::function<double(int u, int v)>& depth_at) {
  Image image(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) image.at(u, v) = static_cast<float>(depth_at(u, v));
  }
  return image;
}

/// Multiplies depths so that they have the noise of a Kinect.
Image noisy(Image image) {
  std::mt19937 generator(1);
  std::normal_distribution<float> gauss;
  for (float& z : image.pixels) z += 1.4e-3F * z * z * gauss(generator);
  return image;
}

struct Searched {
  PlaneSelection selection;
  Effort effort;
};

Searched search(const Image& image, const Parameters& parameters = Parameters()) {
  RayTable rays;
  rays.build(testCamera(kWidth, kHeight));
  const DepthView view = image.view();
  const ImageInput input{
      view,
      rays,
      {1.0F, static_cast<float>(parameters.range_min), static_cast<float>(parameters.range_max)}};
  PlaneSelection selection({kUp, parameters.max_tilt, 0.0, 10.0, 4 * kPoints / 20});
  KdtreeSearch kdtree;
  Effort effort;
  kdtree.run(input, parameters, selection, effort);
  return {selection, effort};
}

TEST(KdtreeSearch, AWallIsGrownOnceAndSaysWhyThereIsNoGround) {
  for (const double distance : {0.6, 1.5, 2.5, 3.5}) {
    const Searched wall = search(noisy(draw([=](int, int) { return distance; })));
    EXPECT_FALSE(wall.selection.found());
    EXPECT_STREQ(stateName(wall.selection.refusal()), "TOO_TILTED");
    EXPECT_LE(wall.effort.tests, 2 * kPoints) << distance;
    EXPECT_GT(wall.effort.tests, kPoints / 2) << distance;
  }
  const Searched exact = search(draw([](int, int) { return 2.0; }));
  EXPECT_EQ(exact.effort.seeds, 1U);
  EXPECT_EQ(exact.effort.regions, 1U);
  EXPECT_EQ(exact.effort.tests, kPoints - 3);
  // Each member asks the tree at least once; the seeds' plane serves an exact region.
  EXPECT_GE(exact.effort.searches, kPoints);
  EXPECT_EQ(exact.effort.fits, 1U);
}

TEST(KdtreeSearch, TiltedRegionsAreGivenUpOnceThereIsGround) {
  // Two fifths of a floor below a wall that is nearer than the floor's end.
  Image image = planeDepth(testCamera(kWidth, kHeight), upOf(0.3), 0.5);
  for (int v = 0; v < kHeight * 3 / 5; ++v) {
    for (int u = 0; u < kWidth; ++u) image.at(u, v) = 0.9F;
  }
  const Searched result = search(image);
  ASSERT_TRUE(result.selection.found());
  EXPECT_GT(-result.selection.plane().normal.dot(upOf(0.3)), std::cos(0.02));
  EXPECT_NEAR(static_cast<double>(result.selection.points()), 0.4 * 4 * kPoints,
              0.02 * 4 * kPoints);
  EXPECT_GT(result.effort.seeds, 10U);
  // The floor, and at most what the window of a seed cuts from its edge.
  EXPECT_LE(result.effort.regions, 2U);
  // The floor, and of each seed on the wall a little more than 200 points.
  EXPECT_LT(result.effort.tests, 2 * kPoints / 5 + 300 * result.effort.seeds);
}

TEST(KdtreeSearch, ASmallFloorIsFoundBehindWallsThatAreGrownFirst) {
  // An eighth of the image is floor, at its lower edge.
  Image image = planeDepth(testCamera(kWidth, kHeight), upOf(0.3), 0.5);
  for (int v = 0; v < kHeight * 7 / 8; ++v) {
    for (int u = 0; u < kWidth; ++u) image.at(u, v) = u < 160 ? 0.9F : 1.2F;
  }
  for (const int random_seed : {1, 2, 3, 4, 5}) {
    Parameters parameters;
    parameters.random_seed = random_seed;
    const Searched result = search(image, parameters);
    ASSERT_TRUE(result.selection.found());
    EXPECT_GT(-result.selection.plane().normal.dot(upOf(0.3)), std::cos(0.02));
    EXPECT_LE(result.effort.tests, 2 * kPoints);
  }
}

TEST(KdtreeSearch, EndsWhenNoLargerRegionIsLeft) {
  const Searched floor = search(planeDepth(testCamera(kWidth, kHeight), upOf(0.9), 0.8));
  EXPECT_TRUE(floor.selection.found());
  EXPECT_EQ(floor.effort.seeds, 1U);
}

TEST(KdtreeSearch, TheUpDirectionSaysWhichHalfIsSearchedFirst) {
  const CameraModel camera = testCamera();
  const Eigen::Vector3d up = upOf(0.4, 0.1);
  // A floor below a wall; and the same image turned by 180 degrees about the optical axis.
  Image image = planeDepth(camera, up, 0.7);
  for (float& z : image.pixels) z = z > 0.0F && z < 2.5F ? z : 2.5F;
  Image turned = image;
  std::reverse(turned.pixels.begin(), turned.pixels.end());
  Parameters parameters;
  parameters.algorithm = Algorithm::kKdtree;
  DominantPlaneDetector detector(parameters);
  const Detection upright = detector.detect(image.view(), camera);
  Prior prior;
  prior.expected_up = Eigen::Vector3d(0.0, 1.0, 0.0);
  const Detection& mirrored = detector.detect(turned.view(), camera, prior);
  ASSERT_TRUE(upright.found() && mirrored.found());
  EXPECT_LT((upright.normal - up).norm(), 0.01);
  EXPECT_LT((mirrored.normal - Eigen::Vector3d(-up.x(), -up.y(), up.z())).norm(), 0.01);
  EXPECT_NEAR(mirrored.distance, upright.distance, 0.005);
  EXPECT_NEAR(static_cast<double>(mirrored.inliers), static_cast<double>(upright.inliers),
              0.01 * static_cast<double>(upright.inliers));
}

/// Images that are hard for region growing, by number.
Image hardImage(int number) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> gauss;
  const auto wave = [](double height) {
    return draw([=](int u, int v) { return 1.0 + height * std::sin(0.1 * u) * std::cos(0.1 * v); });
  };
  switch (number) {
    case 0:
      return draw([&](int, int) { return 0.6 + 0.1 * uniform(generator); });
    case 1:
      return draw([&](int, int) { return 2.0 + 0.05 * gauss(generator); });
    case 2:
      return draw([&](int u, int v) { return 0.6 + 0.05 * ((u / 4 + v / 4) % 2); });
    case 3:
      return wave(0.02);
    case 4:
      return wave(0.1);
    case 5:
      return draw([&](int, int v) { return 0.6 + 0.03 * (v / 16); });
    case 6:  // inside a sphere
      return draw([](int u, int v) {
        const double x = (u - 160) / 262.5, y = (v - 120) / 262.5;
        return 0.3 / std::sqrt(1.0 + x * x + y * y);
      });
    case 7:  // a speck before a wall, all within delta
      return draw([](int u, int v) { return u % 80 < 6 && v % 80 < 6 ? 0.09 : 0.13; });
    default:
      return noisy(draw([](int, int) { return 3.9; }));
  }
}

class HardImage : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Numbers, HardImage, testing::Range(0, 9));

TEST_P(HardImage, CostsABoundedNumberOfTestsAndSearches) {
  const Image image = hardImage(GetParam());
  Parameters parameters;
  parameters.range_min = 0.05;
  parameters.delta = {0.1, 0.0};
  for (const auto& [epsilon, gamma] :
       {std::pair(0.0, 0.05), {0.002, 0.005}, {0.02, 0.05}, {0.02, 0.005}, {1.0, 1.0}}) {
    parameters.epsilon = {epsilon, 0.0};
    parameters.gamma = {gamma, 0.0};
    const Effort effort = search(image, parameters).effort;
    EXPECT_LE(effort.tests, 2 * kPoints) << epsilon << " " << gamma;
    EXPECT_LE(effort.searches, 10 * kPoints) << epsilon << " " << gamma;
    EXPECT_LE(effort.fits, 2 * kPoints) << epsilon << " " << gamma;
  }
}

/// The tiles in which the floor's points lie, whatever was searched before.
TEST(KdtreeSearch, TellsTheTilesOfTheRegion) {
  const auto floor_below = [](int from) {
    return draw([from](int u, int v) {
      const Eigen::Vector2d ray = testCamera(kWidth, kHeight).ray({u, v});
      return v >= from ? 0.5 / (ray.y() * std::cos(0.6) + std::sin(0.6)) : 0.0;
    });
  };
  KdtreeSearch kdtree;
  RayTable rays;
  rays.build(testCamera(kWidth, kHeight));
  for (const int from : {80, 160, 120}) {
    const Image image = floor_below(from);
    const DepthView view = image.view();
    PlaneSelection selection({kUp, 1.05, 0.0, 10.0, 100});
    Effort effort;
    Parameters parameters;
    parameters.range_min = 0.05;
    kdtree.run({view, rays, {1.0F, 0.05F, 4.0F}}, parameters, selection, effort);
    ASSERT_TRUE(selection.found());
    std::vector<std::size_t> expected;
    for (std::size_t tile = static_cast<std::size_t>(from) / 8 * 40; tile < 1200; ++tile) {
      expected.push_back(tile);
    }
    EXPECT_EQ(kdtree.regionTiles(), expected) << from;
    EXPECT_EQ(effort.joined, selection.points() / 4);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
