#include "core/tile_seed.h"

#include <gtest/gtest.h>

#include <set>

#include "support/tile_scene.h"

namespace dominant_plane_detection {
namespace {

/// A wall seen from 1 m: sigma is 3.4 mm, gamma 10.3 mm, delta 20.6 mm, and a tile 30.5 mm wide.
const CameraModel kCamera = testCamera(320, 240);
const HessePlane kWall = facing(1.0);

class TileSeedTest : public testing::Test {
 protected:
  TileSeedTest() : depth_(kCamera.width, kCamera.height) {
    paintTiles(depth_, kCamera, kWall, [](int, int) { return true; });
  }
  /// A seed of tile (20, 15), with the plane's thresholds or others.
  std::optional<TileSeed> seed(const GrowthThresholds& thresholds = growthThresholds({}),
                               int column = 20, int row = 15) {
    TileScene scene(depth_, kCamera, thresholds);
    for (const auto& [c, r] : taken_) scene.taken[scene.at(c, r)] = 1;
    const auto result = fitSeed(scene.judge, scene.taken, scene.at(column, row));
    tiles_.clear();
    if (!result) return result;
    EXPECT_EQ(result->tiles[0], scene.at(column, row));
    PlaneMoments moments;
    for (std::size_t i = 0; i < result->count; ++i) {
      const auto tile = static_cast<int>(result->tiles[i]);
      tiles_.insert({tile % scene.tiles.columns - column, tile / scene.tiles.columns - row});
      moments.add(scene.tiles.count[result->tiles[i]], scene.tiles.centre(result->tiles[i]),
                  scene.tiles.scatter(result->tiles[i]));
    }
    EXPECT_EQ(tiles_.size(), result->count);
    EXPECT_LT(angleBetween(result->fit.plane, moments.fit()->plane), 1e-9);
    EXPECT_DOUBLE_EQ(result->moments.count(), moments.count());
    return result;
  }
  /// Paints a plane on tiles by their offset from the seed's.
  template <typename Where>
  void paint(const HessePlane& plane, Where&& where) {
    paintTiles(depth_, kCamera, plane, [&](int c, int r) { return where(c - 20, r - 15); });
  }

  using Offsets = std::set<std::pair<int, int>>;
  OwnedDepth<float> depth_;
  Offsets taken_;
  Offsets tiles_;  ///< of the last seed
};

TEST_F(TileSeedTest, APlaneGivesNineTilesOfIt) {
  const HessePlane tilted = facing(1.1, 0.3, -0.2);
  paint(tilted, [](int, int) { return true; });
  const auto result = seed();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->count, 9U);
  EXPECT_EQ(result->moments.count(), 9.0 * 64.0);
  EXPECT_LT(angleBetween(result->fit.plane, tilted), 1e-4);
  EXPECT_NEAR(result->fit.plane.distance, tilted.distance, 1e-5);
}

TEST_F(TileSeedTest, AtTheImagesEdgeSixTilesAreEnoughAndFourInACornerAreNot) {
  ASSERT_TRUE(seed(growthThresholds({}), 0, 15));
  EXPECT_EQ(tiles_.size(), 6U);
  ASSERT_TRUE(seed(growthThresholds({}), 20, 29));
  EXPECT_EQ(tiles_.size(), 6U);
  EXPECT_FALSE(seed(growthThresholds({}), 0, 0));
  EXPECT_FALSE(seed(growthThresholds({}), 39, 29));
}

TEST_F(TileSeedTest, FewerThanSixTilesAreNone) {
  const std::vector<std::pair<int, int>> around = {{-1, -1}, {0, -1}, {1, -1}, {1, 1}};
  for (std::size_t k = 0; k < around.size(); ++k) {
    taken_.insert({20 + around[k].first, 15 + around[k].second});
    EXPECT_EQ(seed().has_value(), k < 3) << k;
    EXPECT_EQ(tiles_.size(), k < 3 ? 8 - k : 0);
  }
}

TEST_F(TileSeedTest, TakenTilesDoNotSeed) {
  taken_ = {{20, 15}};
  EXPECT_FALSE(seed());
  taken_ = {{19, 14}};
  ASSERT_TRUE(seed());
  EXPECT_EQ(tiles_.count({-1, -1}), 0U);
}

/// A column of tiles a step away is beyond delta, less than a step it is on the plane or not.
TEST_F(TileSeedTest, WhatLiesOnSomethingElseIsLeftOut) {
  paint(facing(1.25), [](int c, int) { return c > 0; });
  auto result = seed();
  ASSERT_TRUE(result);
  EXPECT_EQ(tiles_, (Offsets{{-1, -1}, {0, -1}, {-1, 0}, {0, 0}, {-1, 1}, {0, 1}}));
  EXPECT_LT(angleBetween(result->fit.plane, kWall), 1e-4);
}

/// One of nine tiles, 2 cm in front, is within delta of the seed, and turns the first plane little.
TEST_F(TileSeedTest, WhatIsOffThePlaneIsLeftOutOnce) {
  paint(facing(0.98), [](int c, int r) { return c == 1 && r == 1; });
  const auto result = seed();
  ASSERT_TRUE(result);
  EXPECT_EQ(result->count, 8U);
  EXPECT_EQ(tiles_.count({1, 1}), 0U);
  EXPECT_LT(angleBetween(result->fit.plane, kWall), 1e-4);
  EXPECT_NEAR(result->fit.plane.distance, 1.0, 1e-5);
  // Where they are the seed itself, there is none.
  EXPECT_TRUE(seed(growthThresholds({}), 22, 16));
  EXPECT_FALSE(seed(growthThresholds({}), 21, 16));
}

TEST_F(TileSeedTest, OnACreaseThereIsNone) {
  paint(facing(1.0, 0.0, 1.0), [](int, int r) { return r > 0; });
  paint(facing(1.0, 0.0, -1.0), [](int, int r) { return r < 0; });
  EXPECT_FALSE(seed());
}

/// The points of two tiles are 30.5 mm apart in a row and 43.1 mm from corner to corner, less 42.8
/// mm of their extents; those in the nearer column, 44.0 mm.
TEST_F(TileSeedTest, DeltaDecidesWhichNeighboursCount) {
  paint(facing(0.99), [](int c, int) { return c == 1; });
  GrowthThresholds wide = growthThresholds({});
  wide.gamma = {0.1, 0.0};
  wide.epsilon = {0.1, 0.0};
  wide.delta = {0.0, 0.0};
  EXPECT_FALSE(seed(wide));
  wide.delta = {0.0008, 0.0};
  ASSERT_TRUE(seed(wide));
  EXPECT_EQ(tiles_, (Offsets{{-1, -1}, {0, -1}, {-1, 0}, {0, 0}, {1, 0}, {-1, 1}, {0, 1}}));
  wide.delta = {0.002, 0.0};
  ASSERT_TRUE(seed(wide));
  EXPECT_EQ(tiles_.size(), 9U);
}

TEST_F(TileSeedTest, TheRoughnessStaysBelowEpsilon) {
  GrowthThresholds thresholds = growthThresholds({});
  thresholds.gamma = {1.0, 0.0};
  thresholds.noise.constant = 0.02;  // so that noise is no slope
  // Readings 4 mm to either side, like a chessboard: the mean square error is 16 mm^2.
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) depth_.at(u, v) = (u + v) % 2 == 0 ? 0.996F : 1.004F;
  }
  for (const auto& [epsilon, expected] : {std::pair(0.00397, false), std::pair(0.00403, true)}) {
    thresholds.epsilon = {epsilon, 0.0};
    EXPECT_EQ(seed(thresholds).has_value(), expected) << epsilon;
  }
}

TEST_F(TileSeedTest, ManyHolesLeaveSeeds) {
  std::mt19937 generator(3);
  for (float& z : depth_.pixels) {
    if (generator() % 10 < 7) z = 0.0F;
  }
  for (int column = 5; column < 35; ++column) {
    EXPECT_TRUE(seed(growthThresholds({}), column, 12)) << column;
  }
}

TEST_F(TileSeedTest, TooFewReadingsAreNoSeedAndDoNotCount) {
  const auto leave = [&](int column, int row, int readings) {
    for (int i = readings; i < 64; ++i) depth_.at(8 * column + i % 8, 8 * row + i / 8) = 0.0F;
  };
  leave(19, 15, 7);
  leave(21, 15, 8);
  ASSERT_TRUE(seed());
  EXPECT_EQ(tiles_.count({-1, 0}), 0U);
  EXPECT_EQ(tiles_.count({1, 0}), 1U);
  leave(20, 15, 7);
  EXPECT_FALSE(seed());
}

}  // namespace
}  // namespace dominant_plane_detection
