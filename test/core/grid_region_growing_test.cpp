#include "core/grid_region_growing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/ray_table.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

const Eigen::Vector3d kUp = upOf(0.5, 0.1);
constexpr double kHeight = 0.8;
const GrowthThresholds kThresholds{NoiseModel(), {0.0, 6.0}, {0.0, 1.0}, {0.0, 3.0}};
constexpr int kColumns = 80;

std::size_t tileAt(int u, int v) {
  return static_cast<std::size_t>(v / kTileSize * kColumns + u / kTileSize);
}

class GridRegionGrowingTest : public testing::Test {
 protected:
  void look(const OwnedDepth<float>& metres, double sigma_z2) {
    RayTable rays;
    rays.build(testCamera());
    computeTileMoments(inMillimetres(metres, sigma_z2).view(), rays, 0.5F, 4.0F, tiles_);
    growing_.start(tiles_, kThresholds);
  }
  /// A floor with a box from one side of the view to the other.
  static OwnedDepth<float> cutFloor() {
    OwnedDepth<float> depth = planeDepth(testCamera(), kUp, kHeight);
    for (int v = 256; v < 320; ++v) {
      for (int u = 0; u < 640; ++u) depth.at(u, v) *= 0.7F;
    }
    return depth;
  }
  static void expectTruth(const HessePlane& plane, double radians, double metres) {
    EXPECT_GT(-plane.normal.dot(kUp), std::cos(radians));
    EXPECT_NEAR(plane.distance, kHeight, metres);
  }

  TileMoments tiles_;
  GridRegionGrowing growing_;
};

TEST_F(GridRegionGrowingTest, GrowsAPlaneFromASeedAndRefinesItOverObstacles) {
  look(cutFloor(), 1.425e-3);
  const auto first = growing_.startRegion(tileAt(320, 440));
  ASSERT_TRUE(first);
  expectTruth(*first, 0.1, 0.1);
  const GridRegionGrowing::Region region = growing_.grow();
  expectTruth(region.plane, 0.01, 0.01);
  const auto refined = growing_.refine(region.plane);
  ASSERT_TRUE(refined);
  expectTruth(refined->plane, 0.0005, 0.0005);
  // Both pieces of the floor are claimed, the box between them is not.
  EXPECT_FALSE(growing_.available(tileAt(320, 440)));
  EXPECT_FALSE(growing_.available(tileAt(320, 200)));
  EXPECT_TRUE(growing_.available(tileAt(320, 288)));
  EXPECT_GT(refined->points, region.points);
}

TEST_F(GridRegionGrowingTest, RefinementIsTheWeightedFitOfTheTilesOnThePlane) {
  look(planeDepth(testCamera(), kUp, kHeight), 1.425e-3);
  const auto refined = growing_.refine(HessePlane{-kUp, kHeight + 0.002});
  ASSERT_TRUE(refined);
  PlaneMoments moments;
  std::size_t points = 0;
  for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
    if (growing_.available(tile) || tiles_.count[tile] < 32.0F) continue;
    const double sigma = kThresholds.noise.sigma(static_cast<double>(tiles_.z[tile]));
    moments.add(static_cast<double>(tiles_.count[tile]), tiles_.centre(tile), tiles_.scatter(tile),
                1.0 / (sigma * sigma));
    points += static_cast<std::size_t>(tiles_.count[tile]);
  }
  const auto fit = moments.fit();
  ASSERT_TRUE(fit);
  EXPECT_EQ(refined->points, points);
  EXPECT_LT((refined->plane.normal - fit->plane.normal).norm(), 2e-5);
  EXPECT_NEAR(refined->plane.distance, fit->plane.distance, 2e-5);
}

TEST_F(GridRegionGrowingTest, SeedsThatLieOnNoPlaneGrowNothing) {
  OwnedDepth<float> chaos(640, 480);
  std::mt19937 generator(5);
  for (float& z : chaos.pixels) z = 0.6F + 0.001F * static_cast<float>(generator() % 3000);
  look(chaos, 0.0);
  const std::size_t before = growing_.availablePoints();
  EXPECT_FALSE(growing_.startRegion(tileAt(320, 240)));
  EXPECT_FALSE(growing_.available(tileAt(320, 240)));  // not drawn again
  EXPECT_EQ(growing_.availablePoints(), before - 64);
}

TEST_F(GridRegionGrowingTest, EmptyTilesAndPlanesThatNothingLiesOn) {
  look(OwnedDepth<float>(640, 480), 0.0);
  EXPECT_EQ(growing_.availablePoints(), 0U);
  EXPECT_FALSE(growing_.available(0));
  EXPECT_FALSE(growing_.startRegion(0));
  EXPECT_FALSE(growing_.refine(HessePlane{{0.0, 1.0, 0.0}, 1.0}));
  // Two tiles side by side: a line, and no plane.
  OwnedDepth<float> two(640, 480);
  for (int v = 240; v < 248; ++v) {
    for (int u = 320; u < 336; ++u) two.at(u, v) = 1.0F;
  }
  look(two, 0.0);
  EXPECT_EQ(growing_.availablePoints(), 128U);
  EXPECT_FALSE(growing_.startRegion(tileAt(320, 240)));
}

TEST_F(GridRegionGrowingTest, DoesNotGrowOverACrease) {
  // The floor ends at a wall.
  OwnedDepth<float> depth = planeDepth(testCamera(), kUp, kHeight);
  for (float& z : depth.pixels) z = z > 0.0F ? std::min(z, 2.0F) : 2.0F;
  look(depth, 1.425e-3);
  ASSERT_TRUE(growing_.startRegion(tileAt(320, 440)));
  const auto refined = growing_.refine(growing_.grow().plane);
  ASSERT_TRUE(refined);
  expectTruth(refined->plane, 0.002, 0.002);
  EXPECT_TRUE(growing_.available(tileAt(320, 40)));
}

}  // namespace
}  // namespace dominant_plane_detection
