#include "core/surface_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "support/tile_scene.h"

namespace dominant_plane_detection {
namespace {

const CameraModel kCamera = testCamera(320, 240);
constexpr int kColumns = 40, kRows = 30;
const NoiseModel kSmoothError{0.0006, 0.0004};  // [m] 2.2 mm at 2 m
constexpr double kDegree = 0.017453292519943295;

/// Tells what two planes make of an image, one on each side of a border.
class SurfaceSplitTest : public testing::Test {
 protected:
  /// @param first where the first plane is; the second one is elsewhere.
  bool find(const HessePlane& a, const HessePlane& b, const std::function<bool(int, int)>& first) {
    OwnedDepth<float> depth(kCamera.width, kCamera.height);
    paintTiles(depth, kCamera, a, first);
    paintTiles(depth, kCamera, b, [&](int c, int r) { return !first(c, r); });
    addNoise(
        depth, [](double z) { return 0.25 * NoiseModel().sigma(z); }, 1);
    const TileScene scene(depth, kCamera);
    region_.clear();
    region_.member.assign(scene.tiles.count.size(), 0);
    region_.plane = facing(2.0);
    for (std::size_t tile = 0; tile < scene.tiles.size(); ++tile) region_.add(tile, scene.tiles);
    return split_.find(scene.judge, region_, kSmoothError);
  }
  /// @return [-] of the tiles on a side of which the first plane was.
  double shareOfFirst(std::size_t side, const std::function<bool(int, int)>& first) const {
    const auto& tiles = split_.sides()[side].tiles;
    const auto count = std::count_if(tiles.begin(), tiles.end(), [&](std::size_t tile) {
      return first(static_cast<int>(tile) % kColumns, static_cast<int>(tile) / kColumns);
    });
    return static_cast<double>(count) / static_cast<double>(tiles.size());
  }
  /// The sides are the planes, in either order, and hold hardly others' tiles.
  void expectSides(const HessePlane& a, const HessePlane& b,
                   const std::function<bool(int, int)>& first) {
    const std::size_t side = shareOfFirst(0, first) > 0.5 ? 0 : 1;
    EXPECT_GT(shareOfFirst(side, first), 0.9);
    EXPECT_LT(shareOfFirst(1 - side, first), 0.1);
    EXPECT_EQ(split_.sides()[0].tiles.size() + split_.sides()[1].tiles.size(), kColumns * kRows);
    const auto expectPlane = [](const HessePlane& plane, const HessePlane& truth) {
      EXPECT_LT(angleBetween(plane, truth), 0.4 * kDegree);
      EXPECT_NEAR(plane.distance, truth.distance, 0.003);
    };
    expectPlane(split_.sides()[side].plane, a);
    expectPlane(split_.sides()[1 - side].plane, b);
  }

  TileRegion region_;
  SurfaceSplit split_;
};

bool left(int column, int) { return column < 16; }

TEST_F(SurfaceSplitTest, AStepIsTwoSurfaces) {
  ASSERT_TRUE(find(facing(2.0), facing(2.02), left));
  expectSides(facing(2.0), facing(2.02), left);
}

TEST_F(SurfaceSplitTest, ARampIsTwoSurfaces) {
  // They meet where z = 2 in both: in the middle row.
  const HessePlane ramp = facing(2.0, 0.0, 5.0 * kDegree);
  const auto upper = [](int, int row) { return row < kRows / 2; };
  ASSERT_TRUE(find(facing(2.0), ramp, upper));
  expectSides(facing(2.0), ramp, upper);
}

/// An island: no straight border.
TEST_F(SurfaceSplitTest, APlateIsASurface) {
  const auto around = [](int column, int row) {
    return std::abs(column - 20) > 9 || std::abs(row - 15) > 8;
  };
  ASSERT_TRUE(find(facing(2.0), facing(1.975), around));
  expectSides(facing(2.0), facing(1.975), around);
}

TEST_F(SurfaceSplitTest, OneSurfaceIsNotTwo) {
  EXPECT_FALSE(find(facing(2.0), facing(2.0), left));
  EXPECT_FALSE(find(facing(2.0, 0.02, -0.03), facing(2.0, 0.02, -0.03), left));
}

/// What the smooth error explains, and each side has to have its share.
TEST_F(SurfaceSplitTest, WhatIsSmallIsNotTold) {
  EXPECT_FALSE(find(facing(2.0), facing(2.002), left));
  const auto most = [](int column, int row) { return column > 3 || row > 4; };
  EXPECT_FALSE(find(facing(2.0), facing(2.02), most));
}

/// Bumps as high as a step, but smaller than what decides: no two planes have them.
TEST_F(SurfaceSplitTest, BumpsAreNoSurfaces) {
  const auto chequered = [](int column, int row) { return (column / 4 + row / 4) % 2 == 0; };
  EXPECT_FALSE(find(facing(2.0), facing(2.02), chequered));
}

TEST_F(SurfaceSplitTest, FewTilesAreOne) {
  OwnedDepth<float> depth(kCamera.width, kCamera.height);
  paintTiles(depth, kCamera, facing(2.0), [](int, int) { return true; });
  const TileScene scene(depth, kCamera);
  region_.member.assign(scene.tiles.count.size(), 0);
  region_.plane = facing(2.0);
  for (const std::size_t tile : {5U, 6U, 7U}) {
    region_.add(tile, scene.tiles);
    EXPECT_FALSE(split_.find(scene.judge, region_, kSmoothError));
  }
}

}  // namespace
}  // namespace dominant_plane_detection
