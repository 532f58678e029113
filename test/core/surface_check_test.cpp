#include "core/surface_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/tile_scene.h"

namespace dominant_plane_detection {
namespace {

const CameraModel kCamera = testCamera(320, 240);
constexpr int kColumns = 40, kRows = 30;
const HessePlane kWall = facing(2.0);

enum class Kind { kOn, kFarther, kNearer, kSteep, kNothing };

/// A picture of tiles, each of its kind; those of the region are on the plane.
class SurfaceCheckTest : public testing::Test {
 protected:
  bool isFilled(const std::function<Kind(int, int)>& kind,
                const std::function<bool(int, int)>& member) {
    OwnedDepth<float> depth(kCamera.width, kCamera.height);
    const auto paint = [&](Kind which, const HessePlane& plane) {
      paintTiles(depth, kCamera, plane, [&](int c, int r) { return kind(c, r) == which; });
    };
    paint(Kind::kOn, kWall);
    paint(Kind::kFarther, facing(3.0));
    paint(Kind::kNearer, facing(1.0));
    // Ramps of 16 cm in each tile, their middles on the plane.
    for (int v = 0; v < kCamera.height; ++v) {
      for (int u = 0; u < kCamera.width; ++u) {
        if (kind(u / 8, v / 8) != Kind::kSteep) continue;
        depth.at(u, v) = 2.0F + 0.02F * (static_cast<float>(u % 8) - 3.5F);
      }
    }
    TileScene scene(depth, kCamera);
    TileRegion region;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        if (member(column, row)) region.tiles.push_back(scene.at(column, row));
      }
    }
    scene.judge.setPlane(kWall, {0.0, 0.0, 2.0});
    return check_.isFilled(scene.judge, region);
  }
  /// The same where the region is all that is on the plane.
  bool isFilled(const std::function<Kind(int, int)>& kind) {
    return isFilled(kind, [&](int c, int r) { return kind(c, r) == Kind::kOn; });
  }

  SurfaceCheck check_;
};

bool inside(int column, int row, int left, int top, int width, int height) {
  return column >= left && column < left + width && row >= top && row < top + height;
}

TEST_F(SurfaceCheckTest, WhatCrossesThePlaneHidesNothing) {
  for (const int hole : {12, 16}) {
    EXPECT_EQ(isFilled([&](int c, int r) {
                const int from = (20 - hole) / 2;
                if (!inside(c, r, 10, 5, 20, 20)) return Kind::kNothing;
                return inside(c, r, 10 + from, 5 + from, hole, hole) ? Kind::kSteep : Kind::kOn;
              }),
              2 * hole * hole <= 400);
  }
}

TEST_F(SurfaceCheckTest, AFilledSquareIs) {
  EXPECT_TRUE(isFilled(
      [](int c, int r) { return inside(c, r, 10, 8, 9, 9) ? Kind::kOn : Kind::kFarther; }));
}

/// A ring of 20 x 20 tiles, one or more wide, about something else.
TEST_F(SurfaceCheckTest, ARingIsWhereHalfOfItLiesOnThePlane) {
  for (int hole = 12; hole <= 18; ++hole) {
    for (const Kind middle : {Kind::kFarther, Kind::kNearer, Kind::kNothing}) {
      const bool is_filled = isFilled([&](int c, int r) {
        if (!inside(c, r, 5, 5, 20, 20)) return Kind::kFarther;
        return inside(c, r, 6, 6, hole, hole) ? middle : Kind::kOn;
      });
      EXPECT_EQ(is_filled, middle != Kind::kFarther || 2 * hole * hole <= 400) << hole;
    }
  }
}

TEST_F(SurfaceCheckTest, ExactlyTheHalfIs) {
  // 10 x 10 tiles, of which the region's four corners and more, until it is half.
  for (const int others : {49, 50, 51}) {
    const auto kind = [&](int c, int r) {
      if (!inside(c, r, 15, 10, 10, 10)) return Kind::kFarther;
      const int number = (r - 10) * 10 + c - 15;
      return number > 20 && number <= 20 + others ? Kind::kFarther : Kind::kOn;
    };
    EXPECT_EQ(isFilled(kind), others <= 50) << others;
  }
}

TEST_F(SurfaceCheckTest, StripesAreNot) {
  const auto stripes = [](int period) {
    return [period](int c, int r) { return (c + r) % period == 0 ? Kind::kOn : Kind::kFarther; };
  };
  EXPECT_TRUE(isFilled(stripes(1)));
  EXPECT_TRUE(isFilled(stripes(2)));
  EXPECT_FALSE(isFilled(stripes(3)));
}

TEST_F(SurfaceCheckTest, TilesOnThePlaneCountEvenWhereTheyAreNotOfTheRegion) {
  const auto edge = [](int c, int r) {
    return inside(c, r, 5, 5, 20, 20) && !inside(c, r, 6, 6, 18, 18);
  };
  EXPECT_TRUE(isFilled([](int, int) { return Kind::kOn; }, edge));
}

/// Twice the area of a triangle, > 0 where it turns to the left.
int turn(int ax, int ay, int bx, int by, int cx, int cy) {
  return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
}

/// Whether a tile is in the hull of others: no line through two of them has it alone on one side.
bool inHull(int x, int y, const std::vector<std::pair<int, int>>& points) {
  for (const auto& [ax, ay] : points) {
    for (const auto& [bx, by] : points) {
      if (ax == bx && ay == by) continue;
      if (turn(ax, ay, bx, by, x, y) >= 0) continue;
      bool edge = true;
      for (const auto& [cx, cy] : points) edge = edge && turn(ax, ay, bx, by, cx, cy) >= 0;
      if (edge) return false;
    }
  }
  return true;
}

/// Random corners, and as many tiles that are farther inside as there may be, or one more.
TEST_F(SurfaceCheckTest, TheHullIsTheConvexHull) {
  std::mt19937 generator(1);
  int checked = 0;
  for (int repeat = 0; repeat < 150; ++repeat) {
    std::vector<std::pair<int, int>> corners(3 + generator() % 8);
    for (auto& [x, y] : corners) {
      x = 3 + static_cast<int>(generator() % 30);
      y = 2 + static_cast<int>(generator() % 24);
    }
    std::vector<std::pair<int, int>> filled;
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        const bool corner = std::count(corners.begin(), corners.end(), std::pair(x, y)) > 0;
        if (!corner && inHull(x, y, corners)) filled.emplace_back(x, y);
      }
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    const std::size_t all = filled.size() + corners.size();
    if (all < 2 * corners.size() + 4) continue;
    std::shuffle(filled.begin(), filled.end(), generator);
    ++checked;
    for (const std::size_t farther : {all / 2, all / 2 + 1}) {
      std::vector<Kind> kinds(kColumns * kRows, Kind::kFarther);
      for (const auto& [x, y] : corners)
        kinds[static_cast<std::size_t>(y * kColumns + x)] = Kind::kOn;
      for (std::size_t i = farther; i < filled.size(); ++i) {
        kinds[static_cast<std::size_t>(filled[i].second * kColumns + filled[i].first)] = Kind::kOn;
      }
      const bool is_filled =
          isFilled([&](int c, int r) { return kinds[static_cast<std::size_t>(r * kColumns + c)]; },
                   [&](int c, int r) {
                     return std::count(corners.begin(), corners.end(), std::pair(c, r)) > 0;
                   });
      EXPECT_EQ(is_filled, 2 * farther <= all) << repeat << ": " << farther << " of " << all;
    }
  }
  EXPECT_GT(checked, 50);
}

TEST_F(SurfaceCheckTest, TooFewReadingsDoNotCount) {
  OwnedDepth<float> depth(kCamera.width, kCamera.height);
  paintTiles(depth, kCamera, facing(3.0), [](int, int) { return true; });
  const auto ring = [](int c, int r) {
    return inside(c, r, 5, 5, 20, 20) && !inside(c, r, 6, 6, 18, 18);
  };
  for (const int readings : {7, 8}) {
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 320; ++u) {
        if (v % 8 * 8 + u % 8 >= readings) depth.at(u, v) = 0.0F;
      }
    }
    if (readings == 8) {
      paintPlane(depth, kCamera, facing(3.0), [](int u, int v) { return v % 8 * 8 + u % 8 < 8; });
    }
    paintTiles(depth, kCamera, kWall, ring);
    TileScene scene(depth, kCamera);
    scene.judge.setPlane(kWall, {0.0, 0.0, 2.0});
    TileRegion region;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) {
        if (ring(column, row)) region.tiles.push_back(scene.at(column, row));
      }
    }
    EXPECT_EQ(check_.isFilled(scene.judge, region), readings == 7);
  }
}

/// Two planes that meet in the image's middle, or one plane and one tile of another.
bool isFlat(double bend, bool rows, bool whole = true) {
  OwnedDepth<float> depth(kCamera.width, kCamera.height);
  const auto half = [&](double angle) {
    return rows ? facing(1.0, 0.0, angle) : facing(1.0, angle, 0.0);
  };
  paintTiles(depth, kCamera, half(0.5 * bend), [](int, int) { return true; });
  paintTiles(depth, kCamera, half(-0.5 * bend),
             [&](int c, int r) { return whole && (rows ? r >= 15 : c >= 20); });
  TileScene scene(depth, kCamera);
  TileRegion region;
  for (std::size_t i = 0; i < scene.tiles.size(); ++i) region.tiles.push_back(i);
  return SurfaceCheck::isFlat(scene.judge, region);
}

/// Beyond two degrees, half of a sigma over a half's width turns each plane: of 20 x 30 tiles of
/// 30.5 mm along the columns, and 40 x 15 along the rows, the second longest axis.
TEST(SurfaceIsFlat, WhereItsHalvesHaveOnePlane) {
  constexpr double kSigma = 0.002 + 1.425e-3, kSide = 8.0 / 262.5;
  for (const bool rows : {false, true}) {
    const double width = (rows ? 15.0 : 20.0) * kSide / std::sqrt(12.0);
    const double limit = 2.0 * M_PI / 180.0 + 0.5 * std::sqrt(2.0) * std::atan(kSigma / width);
    for (const double side : {-1.0, 1.0}) {
      EXPECT_TRUE(isFlat(side * 0.97 * limit, rows)) << rows;
      EXPECT_FALSE(isFlat(side * 1.03 * limit, rows)) << rows;
      EXPECT_TRUE(isFlat(side * 0.5, rows, false)) << rows;
    }
  }
}

TEST(SurfaceIsFlat, WhereAHalfHasNoPlane) {
  OwnedDepth<float> depth(kCamera.width, kCamera.height);
  paintTiles(depth, kCamera, kWall, [](int, int) { return true; });
  TileScene scene(depth, kCamera);
  TileRegion region;
  region.tiles = {scene.at(5, 5)};
  EXPECT_TRUE(SurfaceCheck::isFlat(scene.judge, region));
}

}  // namespace
}  // namespace dominant_plane_detection
