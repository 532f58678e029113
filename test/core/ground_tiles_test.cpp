#include "core/ground_tiles.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>

#include "support/tile_scene.h"

namespace dominant_plane_detection {
namespace {

/// A ground facing the camera at 1 m: sigma 3.425 mm, gamma 10.3 mm, delta 20.6 mm, tiles 30.5 mm.
const CameraModel kCamera = testCamera(320, 240);
const HessePlane kGround = facing(1.0);
using Where = std::function<bool(int, int)>;

/// The columns left of this one are the region.
constexpr int kRegion = 15;

class GroundTilesTest : public testing::Test {
 protected:
  GroundTilesTest() : depth_(kCamera.width, kCamera.height) {
    paintTiles(depth_, kCamera, kGround, [](int column, int) { return column < kRegion; });
  }
  void paint(const HessePlane& plane, const Where& where) {
    paintTiles(depth_, kCamera, plane, where);
  }
  /// Collects the ground.
  /// @return [#] of its tiles beyond the first columns.
  std::size_t collect(bool join_pieces = true, std::size_t min_piece = 1) {
    TileScene scene(depth_, kCamera, thresholds_);
    scene.judge.setPlane(kGround, {0.0, 0.0, 1.0});
    ground_tiles_.start(scene.tiles, scene.tile_angle);
    region_ = TileRegion();
    region_.plane = kGround;
    region_.member.assign(scene.taken.size(), 0);
    for (std::size_t i = 0; i < scene.tiles.size(); ++i) {
      if (i % 40 < kRegion) region_.add(i, scene.tiles);
    }
    ground_tiles_.collect(scene.judge, region_, {join_pieces, min_piece}, scene.taken);
    std::size_t count = 0, points = 0;
    for (std::size_t i = 0; i < scene.tiles.size(); ++i) {
      const bool first = i % 40 < kRegion;
      EXPECT_GE(ground_tiles_.ground()[i], first || region_.member[i]);
      count += !first && ground_tiles_.ground()[i];
    }
    for (const std::size_t tile : region_.tiles) {
      points += static_cast<std::size_t>(scene.tiles.count[tile]);
      EXPECT_TRUE(scene.judge.onPlane(tile));
      EXPECT_EQ(region_.member[tile], 1);
    }
    EXPECT_EQ(region_.points, points);
    for (const std::size_t tile : ground_tiles_.pieces()) {
      EXPECT_EQ(ground_tiles_.ground()[tile], 1);
      EXPECT_EQ(region_.member[tile], 0);
      EXPECT_TRUE(scene.judge.onPlane(tile));
    }
    return count;
  }

  TileRegion region_;
  OwnedDepth<float> depth_;
  GrowthThresholds thresholds_ = growthThresholds({});
  GroundTiles ground_tiles_;
};

bool inside(int column, int row, int left, int top, int width, int height) {
  return column >= left && column < left + width && row >= top && row < top + height;
}

TEST_F(GroundTilesTest, APieceBeyondAGapJoinsIfItMay) {
  paint(kGround, [](int c, int r) { return inside(c, r, 20, 5, 8, 6); });
  paint(kGround, [](int c, int r) { return inside(c, r, 30, 15, 4, 4); });
  EXPECT_EQ(collect(true), 64U);
  EXPECT_EQ(ground_tiles_.pieces().size(), 64U);
  EXPECT_EQ(collect(false), 0U);
  EXPECT_TRUE(ground_tiles_.pieces().empty());
}

TEST_F(GroundTilesTest, WhatHangsTogetherWithTheRegionIsNoPiece) {
  paint(kGround, [](int c, int) { return c == kRegion || c == kRegion + 2; });
  EXPECT_EQ(collect(false), 60U);
  EXPECT_EQ(region_.tiles.size(), 450U + 60U);
  EXPECT_TRUE(ground_tiles_.pieces().empty());
}

TEST_F(GroundTilesTest, APieceIsLargeEnough) {
  paint(kGround, [](int c, int r) { return inside(c, r, 20, 5, 4, 4); });
  EXPECT_EQ(collect(true, 16 * 64), 16U);
  EXPECT_EQ(collect(true, 16 * 64 + 1), 0U);
}

TEST_F(GroundTilesTest, APieceHasASeed) {
  paint(kGround, [](int c, int) { return c == 20; });
  EXPECT_EQ(collect(), 0U);
  paint(kGround, [](int c, int r) { return c == 21 && r < 2; });  // five, each with four others
  eraseTiles(depth_, [](int c, int r) { return c >= 20 && r > 2; });
  EXPECT_EQ(collect(), 0U);
  paint(kGround, [](int c, int r) { return c == 21 && r == 2; });  // five about the middle
  EXPECT_EQ(collect(), 6U);
}

/// All tiles are held against the plane, also those far from a region that is small.
TEST_F(GroundTilesTest, APieceFarFromASmallRegionJoins) {
  eraseTiles(depth_, [](int, int) { return true; });
  paint(kGround,
        [](int c, int r) { return inside(c, r, 0, 0, 3, 3) || inside(c, r, 30, 20, 4, 4); });
  TileScene scene(depth_, kCamera);
  scene.judgeBy(facing(2.0));  // nothing lies on it
  scene.judge.setPlane(kGround, {0.0, 0.0, 1.0});
  ground_tiles_.start(scene.tiles, scene.tile_angle);
  region_ = TileRegion();
  region_.plane = kGround;
  region_.member.assign(scene.taken.size(), 0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) region_.add(scene.at(column, row), scene.tiles);
  }
  ground_tiles_.collect(scene.judge, region_, {true, 1}, scene.taken);
  EXPECT_EQ(ground_tiles_.pieces().size(), 16U);
}

/// A tile that only touches the plane is no seed, however many of its neighbours lie on it.
TEST_F(GroundTilesTest, ASeedLiesOnThePlane) {
  const double sigma = 0.002 + 1.425e-3;
  paint(kGround, [](int c, int r) { return inside(c, r, 20, 5, 3, 3); });
  EXPECT_EQ(collect(), 9U);
  // Rougher, and off by less than gamma: two standard deviations reach beyond it.
  for (int v = 6 * 8; v < 7 * 8; ++v) {
    for (int u = 21 * 8; u < 22 * 8; ++u) {
      depth_.at(u, v) = static_cast<float>(1.0 + 1.9 * sigma) + ((u + v) % 2 == 0 ? 2e-3F : -2e-3F);
    }
  }
  EXPECT_EQ(collect(), 0U);
}

/// A wall that crosses the ground's height: a stripe of it is at that height.
TEST_F(GroundTilesTest, AWallAtItsHeightIsNone) {
  const auto left = [](int column, int) { return column >= 18; };
  // 90 and 40 degrees; seen from the side, and from above.
  paint({{1.0, 0.0, 0.0}, 0.1}, left);
  EXPECT_EQ(collect(), 0U);
  for (const double angle : {0.7, 1.0, 1.3}) {
    paint(HessePlane::through({0.15, 0.0, 1.0}, {std::sin(angle), 0.0, std::cos(angle)}), left);
    EXPECT_EQ(collect(), 0U) << angle;
    paint(HessePlane::through({0.15, 0.0, 1.0}, {0.0, std::sin(angle), std::cos(angle)}), left);
    EXPECT_EQ(collect(), 0U) << angle;
  }
}

/// Three rows or columns of flat tiles like stairs: each has the ground's direction, but the plane
/// fitted to all of them does not.
TEST_F(GroundTilesTest, ThePlaneOfAPieceIsTheSame) {
  thresholds_.gamma = {0.06, 0.0};
  constexpr double kSide = 8.0 / 262.5, kSigma = 0.002 + 1.425e-3;  // [m]
  int joined = 0, refused = 0;
  for (double rise = -0.05; rise < 0.05; rise += 0.001) {
    // Of places and heights of the points.
    Eigen::Matrix2d covariance;
    covariance << kSide * kSide * (2.0 / 3.0 + 63.0 / 64.0 / 12.0), kSide * rise * 2.0 / 3.0,
        kSide * rise * 2.0 / 3.0, rise * rise * 2.0 / 3.0;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
    const Eigen::Vector2d along = solver.eigenvectors().col(1);
    const double angle = std::atan(std::abs(along.y() / along.x()));
    const double limit =
        25.0 * M_PI / 180.0 + std::atan(kSigma / std::sqrt(solver.eigenvalues()[1]));
    if (std::abs(angle - limit) < 0.006) continue;
    for (const bool columns : {false, true}) {
      eraseTiles(depth_, [](int column, int) { return column >= kRegion; });
      for (const int step : {0, 1, 2}) {
        paint(facing(1.0 + (step - 1) * rise), [&](int c, int r) {
          return columns ? c == 20 + step && r >= 10 && r < 20
                         : r == 14 + step && c >= 20 && c < 30;
        });
      }
      EXPECT_EQ(collect(), angle < limit ? 30U : 0U) << rise;
      ++(angle < limit ? joined : refused);
    }
  }
  EXPECT_GT(joined, 20);
  EXPECT_GT(refused, 20);
}

TEST_F(GroundTilesTest, TilesThatTouchAreGroundAndNoPieces) {
  const double sigma = 0.002 + 1.425e-3;
  const auto rough = [](int c, int r) { return inside(c, r, 20, 2, 6, 4) || c == kRegion; };
  paint(facing(1.0 + 1.9 * sigma), rough);
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      if (rough(u / 8, v / 8)) depth_.at(u, v) += (u + v) % 2 == 0 ? 0.002F : -0.002F;
    }
  }
  EXPECT_EQ(collect(), 30U);  // next to the region; the piece has no seed
  EXPECT_EQ(region_.tiles.size(), 450U);
  EXPECT_TRUE(ground_tiles_.pieces().empty());
  paint(kGround, [](int c, int r) { return inside(c, r, 26, 2, 3, 4); });
  EXPECT_EQ(collect(), 30U + 24U + 12U);
  EXPECT_EQ(ground_tiles_.pieces().size(), 12U);
  // All points count for its size.
  EXPECT_EQ(collect(true, 36 * 64), 66U);
  EXPECT_EQ(collect(true, 36 * 64 + 1), 30U);
}

}  // namespace
}  // namespace dominant_plane_detection
