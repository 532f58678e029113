#include "core/tile_moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/ray_table.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

struct Size {
  int width;
  int height;
};

/// Mean and scatter of a tile's points, point by point in double.
void expectTilesOfPoints(const DepthView& depth, const CameraModel& camera, float min, float max) {
  RayTable rays;
  rays.build(camera);
  TileMoments tiles;
  computeTileMoments(depth, rays, min, max, tiles);
  ASSERT_EQ(tiles.columns, (depth.width + 7) / 8);
  ASSERT_EQ(tiles.rows, (depth.height + 7) / 8);
  ASSERT_EQ(tiles.size(), static_cast<std::size_t>(tiles.columns * tiles.rows));
  for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
    const int left = static_cast<int>(tile) % tiles.columns * kTileSize;
    const int top = static_cast<int>(tile) / tiles.columns * kTileSize;
    std::vector<Eigen::Vector3d> points;
    for (int v = top; v < std::min(top + kTileSize, depth.height); ++v) {
      for (int u = left; u < std::min(left + kTileSize, depth.width); ++u) {
        const float z = metresAt(depth, u, v);
        if (z >= min && z <= max && !std::isnan(rays.ray(u, v).x())) {
          points.emplace_back(static_cast<double>(z) * rays.ray(u, v).cast<double>());
        }
      }
    }
    ASSERT_EQ(tiles.count[tile], static_cast<float>(points.size()));
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
    for (const auto& r : points) centre += r / static_cast<double>(points.size());
    for (const auto& r : points) scatter += (r - centre) * (r - centre).transpose();
    ASSERT_LT((tiles.centre(tile) - centre).norm(), 2e-6) << "tile " << tile;
    // A plane's thickness survives: 1e-8 m^2 is a tenth of a millimetre squared.
    const double tolerance = 1e-8 * static_cast<double>(points.size()) + 1e-5 * scatter.norm();
    ASSERT_LE((tiles.scatter(tile) - scatter).norm(), tolerance) << "tile " << tile;
  }
}

/// A plane seen at a grazing angle, with noise, gaps and readings out of range.
OwnedDepth<float> testDepth(const CameraModel& camera) {
  OwnedDepth<float> depth = planeDepth(camera, upOf(0.3, 0.1), 0.8);
  std::mt19937 generator(7);
  for (float& z : depth.pixels) {
    const auto kind = generator() % 16;
    if (kind == 0) z = 0.0F;
    if (kind == 1) z = 9.0F;
    z += 0.003F * static_cast<float>(generator() % 7);
  }
  return depth;
}

class TileMomentsSize : public testing::TestWithParam<Size> {};

TEST_P(TileMomentsSize, EqualTheMomentsOfTheirPoints) {
  const CameraModel camera = testCamera(GetParam().width, GetParam().height);
  const OwnedDepth<float> metres = testDepth(camera);
  expectTilesOfPoints(metres.view(), camera, 0.5F, 4.0F);
  expectTilesOfPoints(inMillimetres(metres).view(), camera, 0.5F, 4.0F);
  CameraModel distorted = camera;
  distorted.distortion = DistortionModel::kPlumbBob;
  distorted.coefficients = {0.05, -0.1, 1e-3, -2e-3, 0.02};
  expectTilesOfPoints(metres.view(), distorted, 0.5F, 4.0F);
  expectTilesOfPoints(inMillimetres(metres).view(), distorted, 0.5F, 4.0F);
}

INSTANTIATE_TEST_SUITE_P(Sizes, TileMomentsSize,
                         testing::Values(Size{640, 480}, Size{320, 240}, Size{1, 1}, Size{7, 5},
                                         Size{8, 8}, Size{9, 17}, Size{161, 121}));

TEST(TileMoments, IgnoreNaNInfiniteAndNegativeReadings) {
  const CameraModel camera = testCamera(24, 16);
  OwnedDepth<float> depth = planeDepth(camera, upOf(1.0), 1.0);
  depth.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
  depth.at(4, 4) = std::numeric_limits<float>::infinity();
  depth.at(5, 5) = -std::numeric_limits<float>::infinity();
  depth.at(6, 6) = -1.0F;
  depth.at(12, 4) = std::numeric_limits<float>::quiet_NaN();  // middle of a tile
  expectTilesOfPoints(depth.view(), camera, 0.5F, 4.0F);
}

TEST(TileMoments, IgnorePixelsWithoutARay) {
  CameraModel camera = testCamera(64, 48);
  camera.distortion = DistortionModel::kPlumbBob;
  camera.coefficients = {-2.0, 0.0, 0.0, 0.0, 0.0};
  const OwnedDepth<float> depth = planeDepth(testCamera(64, 48), upOf(1.0), 1.0);
  RayTable rays;
  rays.build(camera);
  ASSERT_TRUE(std::isnan(rays.ray(0, 0).x()));
  expectTilesOfPoints(depth.view(), camera, 0.5F, 4.0F);
}

TEST(TileMoments, HonourTheStep) {
  const CameraModel camera = testCamera(40, 24);
  const OwnedDepth<std::uint16_t> packed = inMillimetres(testDepth(camera));
  OwnedDepth<std::uint16_t> padded(51, 24);
  for (int v = 0; v < 24; ++v) {
    for (int u = 0; u < 51; ++u) {
      padded.at(u, v) =
          u < 40 ? packed.pixels[static_cast<std::size_t>(v * 40 + u)] : std::uint16_t{777};
    }
  }
  DepthView view = padded.view();
  view.width = 40;
  expectTilesOfPoints(view, camera, 0.5F, 4.0F);
}

}  // namespace
}  // namespace dominant_plane_detection
