#include "core/plane_refinement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/tile_scene.h"

namespace dominant_plane_detection {
namespace {

const CameraModel kCamera = testCamera(320, 240);
const HessePlane kFloor{-upOf(0.9), 1.0};
const auto kAll = [](int, int) { return true; };

/// A region of the tiles for which where(column, row).
template <typename Where>
TileRegion regionOf(const TileScene& scene, const HessePlane& plane, Where&& where) {
  TileRegion region;
  region.plane = plane;
  region.member.assign(scene.tiles.count.size(), 0);
  for (std::size_t i = 0; i < scene.tiles.size(); ++i) {
    const int column = static_cast<int>(i) % scene.tiles.columns;
    if (scene.tiles.count[i] < 8.0F) continue;
    if (!where(column, static_cast<int>(i) / scene.tiles.columns)) continue;
    region.tiles.push_back(i);
    region.member[i] = 1;
    region.points += static_cast<std::size_t>(scene.tiles.count[i]);
  }
  return region;
}

OwnedDepth<float> floorDepth() {
  OwnedDepth<float> depth(kCamera.width, kCamera.height);
  paintTiles(depth, kCamera, kFloor, kAll);
  return depth;
}

/// The fit by weighted moments of a region's tiles within a level.
HessePlane momentsFit(TileScene& scene, const TileRegion& region, const HessePlane& near,
                      float level) {
  scene.judgeBy(near, level);
  PlaneMoments moments;
  for (const std::size_t tile : region.tiles) {
    if (!scene.judge.onPlane(tile)) continue;
    const double z = static_cast<double>(scene.tiles.z[tile]);
    const double sigma = 0.002 + 1.425e-3 * z * z;
    moments.add(scene.tiles.count[tile], scene.tiles.centre(tile), scene.tiles.scatter(tile),
                1.0 / (sigma * sigma));
  }
  return moments.fit()->plane;
}

TEST(PlaneRefinement, FitsByWeightedLeastSquares) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    OwnedDepth<float> depth = floorDepth();
    // What bends the floor, so that the weights matter.
    for (int v = 0; v < depth.height; ++v) {
      for (int u = 0; u < depth.width; ++u) {
        depth.at(u, v) +=
            0.004F * std::sin(0.02F * static_cast<float>(v) +
                              static_cast<float>(u) * 0.01F * static_cast<float>(seed));
      }
    }
    addNoise(
        depth, [](double z) { return 1e-3 * z * z; }, seed);
    TileScene scene(depth, kCamera);
    const TileRegion region = regionOf(scene, kFloor, kAll);
    HessePlane start = kFloor;
    start.distance += 0.002;
    const float level = 2.5F;
    const auto fitted = fitPlane(scene.judge, region, start, level);
    ASSERT_TRUE(fitted);
    const HessePlane expected = momentsFit(scene, region, fitted->plane, level);
    EXPECT_LT(angleBetween(fitted->plane, expected), 2e-5);
    EXPECT_NEAR(fitted->plane.distance, expected.distance, 2e-5);
    EXPECT_EQ(fitted->level, level);
    EXPECT_GE(fitted->fits, 2U);
    EXPECT_LE(fitted->fits, 4U);
    // The weights matter: without them it is another plane.
    PlaneMoments plain;
    for (const std::size_t tile : region.tiles) {
      plain.add(scene.tiles.count[tile], scene.tiles.centre(tile), scene.tiles.scatter(tile));
    }
    EXPECT_GT(angleBetween(plain.fit()->plane, expected), 1e-4);
  }
}

TEST(PlaneRefinement, ConvergesFromATiltedStart) {
  TileScene scene(floorDepth(), kCamera);
  const TileRegion region = regionOf(scene, kFloor, kAll);
  HessePlane start = kFloor;
  start.normal = (start.normal + Eigen::Vector3d(0.003, 0.001, 0.0)).normalized();
  const auto fitted = fitPlane(scene.judge, region, start, 5.0F);
  ASSERT_TRUE(fitted);
  EXPECT_LT(angleBetween(fitted->plane, kFloor), 2e-5);
  EXPECT_NEAR(fitted->plane.distance, 1.0, 2e-5);
  EXPECT_EQ(fitted->fits, 2U);
  // From far off, what lies within gamma of the start becomes more step by step.
  start.normal = (start.normal + Eigen::Vector3d(0.2, 0.1, 0.0)).normalized();
  const auto far = fitPlane(scene.judge, region, start, 5.0F);
  ASSERT_TRUE(far);
  EXPECT_EQ(far->fits, 4U);
  // From farther still it would go on, but has to end.
  OwnedDepth<float> rough = floorDepth();
  addNoise(
      rough, [](double z) { return 1e-3 * z * z; }, 3);
  TileScene noisy(rough, kCamera);
  const HessePlane farther = {(kFloor.normal + Eigen::Vector3d(0.138, 0.069, 0.0)).normalized(),
                              1.0};
  const auto ended = fitPlane(noisy.judge, region, farther, 0.6F);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->fits, 4U);
  const auto further = fitPlane(noisy.judge, region, ended->plane, 0.6F);
  ASSERT_TRUE(further);
  EXPECT_GT(angleBetween(ended->plane, further->plane), 0.01);
}

/// A tenth of a millimetre, or of a milliradian, is final.
TEST(PlaneRefinement, EndsWhenThePlaneMovesNoFurther) {
  OwnedDepth<float> depth(kCamera.width, kCamera.height);
  paintTiles(depth, kCamera, facing(1.0), kAll);
  TileScene scene(depth, kCamera);
  const TileRegion region = regionOf(scene, facing(1.0), kAll);
  const auto fits = [&](const HessePlane& start) {
    const auto fitted = fitPlane(scene.judge, region, start, 5.0F);
    return fitted ? fitted->fits : 0U;
  };
  EXPECT_EQ(fits(facing(1.0)), 1U);
  EXPECT_EQ(fits(facing(1.0 + 0.9e-4)), 1U);
  EXPECT_EQ(fits(facing(1.0 - 0.9e-4)), 1U);
  EXPECT_EQ(fits(facing(1.0 + 1.1e-4)), 2U);
  EXPECT_EQ(fits(facing(1.0 - 1.1e-4)), 2U);
  EXPECT_EQ(fits(facing(1.0, 0.9e-4, 0.0)), 1U);
  EXPECT_EQ(fits(facing(1.0, 1.1e-4, 0.0)), 2U);
  EXPECT_EQ(fits(facing(1.0, 0.0, -1.1e-4)), 2U);
}

TEST(PlaneRefinement, OneSurfaceStaysWhatItIs) {
  OwnedDepth<float> depth = floorDepth();
  addNoise(
      depth, [](double z) { return 1e-3 * z * z; }, 4);
  TileScene scene(depth, kCamera);
  const TileRegion region = regionOf(scene, kFloor, kAll);
  const auto refined = findSurface(scene.judge, region);
  ASSERT_TRUE(refined);
  const HessePlane expected =
      momentsFit(scene, region, kFloor, std::numeric_limits<float>::infinity());
  EXPECT_LT(angleBetween(refined->plane, expected), 1e-4);
  EXPECT_NEAR(refined->plane.distance, expected.distance, 1e-4);
}

struct Levels {
  double step;  ///< [m]
  int first;    ///< column of the higher level, of 40
  unsigned seed;
};
class TwoLevels : public testing::TestWithParam<Levels> {};

/// The region's plane lies between two levels.
TEST_P(TwoLevels, OneOfThemIsThePlane) {
  const auto [step, first, seed] = GetParam();
  HessePlane plate = kFloor;
  plate.distance -= step;
  OwnedDepth<float> depth = floorDepth();
  const int from = first;
  paintTiles(depth, kCamera, plate, [&](int column, int) { return column >= from; });
  addNoise(
      depth, [](double) { return 5e-4; }, seed);
  GrowthThresholds thresholds = growthThresholds({});
  thresholds.gamma = {0.1, 0.0};
  TileScene scene(depth, kCamera, thresholds);
  PlaneMoments moments;
  TileRegion region = regionOf(scene, kFloor, kAll);
  for (const std::size_t tile : region.tiles) {
    moments.add(scene.tiles.count[tile], scene.tiles.centre(tile), scene.tiles.scatter(tile));
  }
  region.plane = moments.fit()->plane;
  const auto refined = findSurface(scene.judge, region);
  ASSERT_TRUE(refined);
  EXPECT_LT(angleBetween(refined->plane, kFloor), 0.1 * M_PI / 180.0);
  const double off = std::min(std::abs(refined->plane.distance - 1.0),
                              std::abs(refined->plane.distance - (1.0 - step)));
  EXPECT_LT(off, 1e-3) << refined->plane.distance;
  // Where one has 70 % of the points, it is that one.
  if (from >= 28) {
    EXPECT_NEAR(refined->plane.distance, 1.0, 1e-3);
  }
  if (from <= 12) {
    EXPECT_NEAR(refined->plane.distance, 1.0 - step, 1e-3);
  }
}
INSTANTIATE_TEST_SUITE_P(Steps, TwoLevels,
                         testing::Values(Levels{0.015, 28, 1}, Levels{0.02, 28, 2},
                                         Levels{0.03, 28, 3}, Levels{0.02, 12, 4},
                                         Levels{0.03, 12, 5}, Levels{0.02, 24, 6},
                                         Levels{0.03, 16, 7}, Levels{0.04, 20, 8},
                                         Levels{0.025, 20, 9}));

TEST(PlaneRefinement, ExactReadingsHaveTheSmallestLevel) {
  TileScene scene(floorDepth(), kCamera);
  const auto refined = findSurface(scene.judge, regionOf(scene, kFloor, kAll));
  ASSERT_TRUE(refined);
  EXPECT_EQ(refined->level, 0.3F);
  EXPECT_EQ(refined->fits, 2U);
  EXPECT_LT(angleBetween(refined->plane, kFloor), 2e-5);
}

/// Tiles that are off by a normally distributed height each; three of their standard deviations.
TEST(PlaneRefinement, TheLevelFollowsTheScatter) {
  for (const double scatter : {0.2, 0.35, 0.5}) {
    OwnedDepth<float> depth(kCamera.width, kCamera.height);
    std::mt19937 generator(11);
    std::normal_distribution<double> gauss;
    std::vector<double> off(1200);
    for (double& o : off) o = scatter * (0.002 + 1.425e-3) * gauss(generator);
    for (int i = 0; i < 1200; ++i) {
      paintTiles(depth, kCamera, facing(1.0 + off[static_cast<std::size_t>(i)]),
                 [&](int column, int row) { return row * 40 + column == i; });
    }
    TileScene scene(depth, kCamera);
    const auto refined = findSurface(scene.judge, regionOf(scene, facing(1.0), kAll));
    ASSERT_TRUE(refined);
    EXPECT_NEAR(refined->level, 3.0 * scatter, 0.15 * 3.0 * scatter);
  }
}

TEST(PlaneRefinement, TooFewTilesDetermineNothing) {
  TileScene scene(floorDepth(), kCamera);
  const auto refined = [&](auto&& where) {
    const TileRegion region = regionOf(scene, kFloor, where);
    EXPECT_EQ(findSurface(scene.judge, region).has_value(),
              fitPlane(scene.judge, region, kFloor, 3.0F).has_value());
    return findSurface(scene.judge, region).has_value();
  };
  EXPECT_FALSE(refined([](int column, int row) { return column == 20 && row == 20; }));
  EXPECT_FALSE(refined([](int, int row) { return row == 20; }));
  EXPECT_TRUE(refined(
      [](int column, int row) { return column >= 20 && column < 23 && row >= 20 && row < 22; }));
  // Nor do tiles that are off the plane.
  HessePlane far = kFloor;
  far.distance += 0.5;
  EXPECT_FALSE(fitPlane(scene.judge, regionOf(scene, kFloor, kAll), far, 3.0F));
}

}  // namespace
}  // namespace dominant_plane_detection
