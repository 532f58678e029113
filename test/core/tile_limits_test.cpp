#include "core/tile_limits.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dominant_plane_detection {
namespace {

constexpr GrowthThresholds kThresholds{{0.003, 0.0011}, {0.02, 5.0}, {0.004, 0.7}, {0.001, 2.5}};

/// A row of tiles in front of a camera, at depths of their own.
TileMoments tilesAt(const std::vector<float>& depths) {
  TileMoments tiles;
  tiles.resize(kTileSize * static_cast<int>(depths.size()), kTileSize);
  std::copy(depths.begin(), depths.end(), tiles.z.begin());
  return tiles;
}

TEST(TileLimits, FollowTheNoiseOfTheTilesDepth) {
  TileMoments tiles = tilesAt({0.5F, 1.0F, 2.0F, 3.5F, 4.0F});
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    tiles.xx[i] = 1e-4F * static_cast<float>(i + 1);
    tiles.yy[i] = 3e-5F * static_cast<float>(2 * i + 1);
    tiles.zz[i] = 2e-5F * static_cast<float>(7 - i);
    tiles.xy[i] = tiles.xz[i] = tiles.yz[i] = 1e-5F;
  }
  TileLimits limits;
  limits.set(tiles, kThresholds);
  ASSERT_EQ(limits.delta.size(), tiles.count.size());
  ASSERT_EQ(limits.radius.size(), tiles.count.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const double z = static_cast<double>(tiles.z[i]);
    const double sigma = 0.003 + 0.0011 * z * z;
    const double epsilon = 0.004 + 0.7 * sigma;
    EXPECT_NEAR(limits.delta[i], 0.02 + 5.0 * sigma, 1e-8) << z;
    EXPECT_NEAR(limits.epsilon2[i], epsilon * epsilon, 1e-10) << z;
    EXPECT_NEAR(limits.gamma[i], 0.001 + 2.5 * sigma, 1e-8) << z;
    EXPECT_NEAR(limits.inverse_sigma[i] * sigma, 1.0, 1e-6) << z;
    const double variance = static_cast<double>(tiles.xx[i] + tiles.yy[i] + tiles.zz[i]);
    EXPECT_NEAR(limits.radius[i], std::sqrt(3.0 * variance), 1e-7) << z;
  }
}

/// The points of a rod have half its length from the centre to the end.
TEST(TileLimits, TheRadiusIsHalfTheExtent) {
  TileMoments tiles = tilesAt({1.0F});
  double square = 0.0;
  constexpr int kPoints = 1000;
  for (int i = 0; i < kPoints; ++i) square += std::pow((i + 0.5) / kPoints - 0.5, 2) / kPoints;
  tiles.yy[0] = static_cast<float>(square);
  TileLimits limits;
  limits.set(tiles, kThresholds);
  EXPECT_NEAR(limits.radius[0], 0.5, 1e-4);
}

class CloserThanDelta : public testing::Test {
 protected:
  /// Two tiles, so far apart along a direction that `gap` is left between their points.
  bool close(const Eigen::Vector3d& direction, double gap) {
    TileMoments tiles = tilesAt({1.0F, 1.0F});
    tiles.xx[0] = 3e-4F;
    tiles.xx[1] = 1e-4F;
    TileLimits limits;
    limits.set(tiles, kThresholds);
    limits.delta[0] = 0.03F;
    limits.delta[1] = 0.5F;  // the other one's says nothing
    const double apart = 0.03 + std::sqrt(9e-4) + std::sqrt(3e-4);
    const Eigen::Vector3d offset = direction.normalized() * (apart + gap);
    tiles.x[1] = static_cast<float>(offset.x());
    tiles.y[1] = static_cast<float>(offset.y());
    tiles.z[1] = 1.0F + static_cast<float>(offset.z());
    return closerThanDelta(tiles, limits, 0, 1);
  }
};

TEST_F(CloserThanDelta, CountsFromPointToPoint) {
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, 1),
        Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 2, -2), Eigen::Vector3d(-3, 1, 2)}) {
    EXPECT_TRUE(close(direction, -1e-5)) << direction.transpose();
    EXPECT_FALSE(close(direction, 1e-5)) << direction.transpose();
  }
}

}  // namespace
}  // namespace dominant_plane_detection
