#include "core/tile_growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/tile_scene.h"

namespace dominant_plane_detection {
namespace {

/// At 1 m sigma is 3.425 mm, gamma 10.3 mm, delta 20.6 mm, and a tile 30.5 mm wide.
const CameraModel kCamera = testCamera(320, 240);
constexpr double kSide = 8.0 / 262.5;  // [m]
const HessePlane kWall = facing(1.0);
const auto kAll = [](int, int) { return true; };

class TileGrowthTest : public testing::Test {
 protected:
  TileGrowthTest() : depth_(kCamera.width, kCamera.height) {
    paintTiles(depth_, kCamera, kWall, kAll);
  }
  /// Grows from a tile.
  const TileRegion& grow(TileScene& scene, int column = 5, int row = 15) {
    growth_.start(scene.tiles, scene.tile_angle);
    const auto seed = fitSeed(scene.judge, scene.taken, scene.at(column, row));
    EXPECT_TRUE(seed);
    return growth_.grow(scene.judge, *seed, scene.taken);
  }
  /// @return [#] of tiles that a region grown from a tile has.
  std::size_t grown(int column = 5, int row = 15) {
    TileScene scene(depth_, kCamera, thresholds_);
    return grow(scene, column, row).tiles.size();
  }

  OwnedDepth<float> depth_;
  GrowthThresholds thresholds_ = growthThresholds({});
  TileGrowth growth_;
};

TEST_F(TileGrowthTest, APlaneIsOneRegion) {
  const HessePlane tilted = facing(1.2, 0.2, -0.4);
  paintTiles(depth_, kCamera, tilted, kAll);
  TileScene scene(depth_, kCamera);
  const TileRegion& region = grow(scene);
  EXPECT_EQ(region.tiles.size(), 1200U);
  EXPECT_EQ(region.points, 320U * 240U);
  EXPECT_EQ(std::set<std::size_t>(region.tiles.begin(), region.tiles.end()).size(), 1200U);
  for (std::size_t i = 0; i < scene.tiles.size(); ++i) EXPECT_EQ(region.member[i], 1);
  EXPECT_LT(angleBetween(region.plane, tilted), 1e-5);
  EXPECT_NEAR(region.plane.distance, tilted.distance, 1e-5);
  EXPECT_EQ(scene.judge.test().level, std::numeric_limits<float>::infinity());
  // By half from 9 to 1200 in twelve steps at most, and at both ends.
  EXPECT_GE(growth_.fits(), 9U);
  EXPECT_LE(growth_.fits(), 14U);
  EXPECT_EQ(growth_.tests(), 1200U - 9U);
}

TEST_F(TileGrowthTest, NothingIsCountedBeforeAnythingIsGrown) {
  EXPECT_EQ(growth_.fits(), 0U);
  EXPECT_EQ(growth_.tests(), 0U);
}

TEST_F(TileGrowthTest, ThePlaneIsTheFitOfTheTiles) {
  addNoise(
      depth_, [](double) { return 0.003; }, 5);
  TileScene scene(depth_, kCamera);
  const TileRegion& region = grow(scene);
  EXPECT_GT(region.tiles.size(), 1190U);
  PlaneMoments moments;
  for (const std::size_t tile : region.tiles) {
    moments.add(scene.tiles.count[tile], scene.tiles.centre(tile), scene.tiles.scatter(tile));
  }
  EXPECT_LT(angleBetween(region.plane, moments.fit()->plane), 1e-9);
  EXPECT_NEAR(region.plane.distance, moments.fit()->plane.distance, 1e-9);
  EXPECT_EQ(static_cast<double>(region.points), moments.count());
  EXPECT_LT(angleBetween(region.plane, kWall), 3e-4);
}

/// The scatter within the tiles is all that tells the plane of a strip two tiles wide, which
/// falls off across it as far as a tile may.
TEST_F(TileGrowthTest, TheTilesOwnScatterTurnsThePlane) {
  const HessePlane tilted = facing(1.0, 0.0, 0.3);
  eraseTiles(depth_, kAll);
  paintTiles(depth_, kCamera, tilted, [](int, int row) { return row >= 14 && row < 16; });
  TileScene scene(depth_, kCamera);
  const TileRegion& region = grow(scene);
  ASSERT_EQ(region.tiles.size(), 80U);
  EXPECT_LT(angleBetween(region.plane, tilted), 1e-4);
}

TEST_F(TileGrowthTest, ACreaseIsNotGrownOver) {
  // A floor and a wall that meet below row 19, at right angles.
  const double y = (160.0 - 0.5 - 119.5) / 262.5;
  const HessePlane floor = HessePlane::through({0.0, y, 1.0}, {0.0, 1.0, 0.0});
  paintPlane(depth_, kCamera, floor, [](int, int v) { return v >= 160; });
  EXPECT_EQ(grown(), 40U * 20U);
  EXPECT_EQ(grown(20, 27), 40U * 10U);
}

TEST_F(TileGrowthTest, AStepOfTwoGammasIsNotGrownOver) {
  const double gamma = 3.0 * (0.002 + 1.425e-3);
  for (const double side : {-1.0, 1.0}) {
    const auto right = [](int column, int) { return column >= 20; };
    paintTiles(depth_, kCamera, facing(1.0 + side * 2.0 * gamma), right);
    EXPECT_EQ(grown(), 600U);
    paintTiles(depth_, kCamera, facing(1.0 + side * 0.25 * gamma), right);
    EXPECT_EQ(grown(), 1200U);
  }
}

/// Columns or rows of tiles without a reading, or with something in front, of `tiles` in width.
class TileGrowthGap : public TileGrowthTest, public testing::WithParamInterface<int> {
 protected:
  /// @return [#] of tiles beyond the gap that are grown from those before it.
  std::size_t beyond(int tiles, bool rows, bool obstacle) {
    const auto in_gap = [&](int column, int row) {
      const int at = rows ? row : column;
      return at >= 15 && at < 15 + tiles;
    };
    paintTiles(depth_, kCamera, kWall, kAll);
    eraseTiles(depth_, in_gap);
    if (obstacle) paintTiles(depth_, kCamera, facing(0.5), in_gap);
    std::size_t sizes[2];
    for (const bool back : {false, true}) {
      TileScene scene(depth_, kCamera, thresholds_);
      const TileRegion& region = back ? grow(scene, 35, 27) : grow(scene, 5, 5);
      sizes[back] = 0;
      for (const std::size_t tile : region.tiles) {
        const int at = rows ? static_cast<int>(tile) / 40 : static_cast<int>(tile) % 40;
        sizes[back] += back ? at < 15 : at >= 15 + tiles;
      }
    }
    const std::size_t before = 15U * (rows ? 40U : 30U);
    EXPECT_EQ(sizes[0] + before + static_cast<std::size_t>(tiles) * (rows ? 40U : 30U),
              sizes[0] > 0 ? 1200U : before + static_cast<std::size_t>(tiles) * (rows ? 40U : 30U));
    EXPECT_EQ(sizes[1], sizes[0] > 0 ? before : 0U);
    return sizes[0];
  }
};
INSTANTIATE_TEST_SUITE_P(Tiles, TileGrowthGap, testing::Values(1, 2, 3, 5));

/// Delta is a millimetre more or less than the gap, from point to point: tiles reach 0.70 of their
/// side, so that 0.40 of one are seen as bridged before delta is.
TEST_P(TileGrowthGap, AGapNarrowerThanDeltaIsBridged) {
  const int tiles = GetParam();
  const double reach = 2.0 * std::sqrt(0.5 * (1.0 - 1.0 / 64.0)) - 1.0;
  const double gap = (tiles - reach) * kSide;  // [m]
  for (const bool rows : {false, true}) {
    for (const bool obstacle : {false, true}) {
      const double sigma = 0.002 + 1.425e-3;
      for (const DepthThreshold bridge :
           {DepthThreshold{gap + 1e-3, 0.0}, DepthThreshold{0.0, (gap + 1e-3) / sigma},
            DepthThreshold{tiles * kSide, 0.0}}) {
        thresholds_.delta = bridge;
        EXPECT_GT(beyond(tiles, rows, obstacle), 0U) << rows << obstacle;
      }
      for (const DepthThreshold narrow :
           {DepthThreshold{gap - 1e-3, 0.0}, DepthThreshold{0.0, (gap - 1e-3) / sigma}}) {
        thresholds_.delta = narrow;
        EXPECT_EQ(beyond(tiles, rows, obstacle), 0U) << rows << obstacle;
      }
    }
  }
}

/// Two pieces, islands without neighbours, one beyond the other.
TEST_F(TileGrowthTest, GapsAreBridgedOneAfterTheOther) {
  const auto gap = [](int column, int) { return column % 10 == 9; };
  eraseTiles(depth_, gap);
  thresholds_.delta = {kSide, 0.0};
  EXPECT_EQ(grown(), 30U * 36U);
  EXPECT_EQ(grown(35, 10), 30U * 36U);
  thresholds_.delta = {0.5 * kSide, 0.0};
  EXPECT_EQ(grown(), 30U * 9U);
}

/// A chessboard of readings to either side of the wall has a mean square error of its own.
TEST_F(TileGrowthTest, ARoughPatchAboveEpsilonDoesNotJoin) {
  thresholds_.noise.constant = 0.02;
  thresholds_.gamma = {1.0, 0.0};
  for (int v = 0; v < 240; ++v) {
    for (int u = 160; u < 320; ++u) depth_.at(u, v) = (u + v) % 2 == 0 ? 0.99F : 1.01F;
  }
  // Half of all points are 10 mm off: 7.07 mm altogether.
  thresholds_.epsilon = {0.0075, 0.0};
  EXPECT_EQ(grown(), 1200U);
  // The share of rough points in the region is (2 / 10)^2.
  thresholds_.epsilon = {0.002, 0.0};
  EXPECT_EQ(grown(), 600U + 600U / 24U);
  thresholds_.epsilon = {1e-4, 0.0};
  EXPECT_EQ(grown(), 600U);
}

/// Neighbours in the image with readings at their far ends only: 12 pixels, 46 mm, are between
/// them.
TEST_F(TileGrowthTest, DeltaDecidesBetweenNeighbours) {
  for (int v = 0; v < 240; ++v) {
    for (int u = 160 - 6; u < 160 + 6; ++u) depth_.at(u, v) = 0.0F;
  }
  thresholds_.delta = {0.01, 0.0};
  EXPECT_EQ(grown(), 600U);
  thresholds_.delta = {0.04, 0.0};
  EXPECT_EQ(grown(), 1200U);
}

/// Where delta is no limit, the tiles whose means are closer than gamma surround the region.
TEST_F(TileGrowthTest, GammaAloneDecidesOnATiltedNeighbour) {
  constexpr double kSlope = 0.05;
  const HessePlane tilted = facing(1.0, -kSlope, 0.0);  // z = 1 + 0.05 x
  paintTiles(depth_, kCamera, tilted, [](int column, int) { return column >= 20; });
  for (const double gamma : {0.004, 0.008, 0.012}) {
    thresholds_.gamma = {gamma, 0.0};
    TileScene scene(depth_, kCamera, thresholds_);
    scene.judge.setPlane(kWall, {0.0, 0.0, 1.0});
    scene.judge.judgeAll();
    growth_.start(scene.tiles, scene.tile_angle);
    const TileRegion& region = growth_.surround(scene.judge, {scene.at(5, 15)}, scene.taken);
    int columns = 0;
    while (columns < 20) {
      const double middle = (columns + 0.5) * kSide;
      if (kSlope * middle > gamma) break;
      ++columns;
    }
    EXPECT_NEAR(static_cast<double>(region.tiles.size()), 30.0 * (20 + columns), 30.0);
    EXPECT_GT(region.tiles.size(), 600U);
    EXPECT_LT(region.tiles.size(), 1200U);
  }
}

TEST_F(TileGrowthTest, TakenTilesDoNotJoin) {
  TileScene scene(depth_, kCamera);
  for (int row = 0; row < 30; ++row) scene.taken[scene.at(20, row)] = 1;
  const TileRegion& region = grow(scene);
  EXPECT_EQ(region.tiles.size(), 1170U);  // a gap of one tile is less than delta
  for (int row = 0; row < 30; ++row) EXPECT_EQ(region.member[scene.at(20, row)], 0);
  for (int row = 0; row < 30; ++row) scene.taken[scene.at(21, row)] = 1;
  EXPECT_EQ(grow(scene).tiles.size(), 600U);
  scene.taken[scene.at(20, 7)] = scene.taken[scene.at(21, 7)] = 0;
  EXPECT_EQ(grow(scene).tiles.size(), 1200U - 58U);
}

TEST_F(TileGrowthTest, WhatWasGrownBeforeDoesNotMatter) {
  eraseTiles(depth_, [](int column, int) { return column >= 19 && column < 25; });
  addNoise(
      depth_, [](double) { return 0.002; }, 9);
  TileScene fresh(depth_, kCamera), used(depth_, kCamera);
  const TileRegion expected = grow(fresh);
  const std::size_t tests = growth_.tests(), fits = growth_.fits();
  TileGrowth again;
  again.start(used.tiles, used.tile_angle);
  for (const int column : {35, 5}) {
    const auto seed = fitSeed(used.judge, used.taken, used.at(column, 15));
    const TileRegion& region = again.grow(used.judge, *seed, used.taken);
    if (column == 35) continue;
    EXPECT_EQ(region.tiles, expected.tiles);
    EXPECT_EQ(region.member, expected.member);
    EXPECT_EQ(region.points, expected.points);
    EXPECT_EQ(region.plane.normal, expected.plane.normal);
    EXPECT_EQ(again.tests(), tests);
    EXPECT_EQ(again.fits(), fits);
  }
}

TEST_F(TileGrowthTest, SurroundTakesWhatTouchesByDeltaAlone) {
  const double sigma = 0.002 + 1.425e-3;
  // 1.9 sigma off with noise: touches, is not on the plane, and far above epsilon.
  paintTiles(depth_, kCamera, facing(1.0 + 1.9 * sigma), [](int c, int) { return c >= 10; });
  for (int v = 0; v < 240; ++v) {
    for (int u = 80; u < 320; ++u) depth_.at(u, v) += (u + v) % 2 == 0 ? 0.002F : -0.002F;
  }
  eraseTiles(depth_, [](int c, int) { return c >= 30 && c < 33; });
  TileScene scene(depth_, kCamera);
  scene.judgeBy(kWall);
  ASSERT_EQ(scene.judge.verdict(scene.at(20, 15)), TileVerdict::kTouches);
  growth_.start(scene.tiles, scene.tile_angle);
  const std::vector<std::size_t> first = {scene.at(5, 5), scene.at(2, 2)};
  EXPECT_EQ(growth_.surround(scene.judge, first, scene.taken).tiles.size(), 900U);
  EXPECT_EQ(growth_.fits(), 0U);
  const std::vector<std::size_t> both = {scene.at(5, 5), scene.at(35, 2)};
  EXPECT_EQ(growth_.surround(scene.judge, both, scene.taken).tiles.size(), 1110U);
}

}  // namespace
}  // namespace dominant_plane_detection
