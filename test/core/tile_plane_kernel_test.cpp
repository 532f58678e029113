#include "core/tile_plane_kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "support/tile_scene.h"

namespace dominant_plane_detection {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
using Points = std::vector<Eigen::Vector3d>;

/// The points of each tile, as the moments have them.
std::vector<Points> pointsOfTiles(const OwnedDepth<float>& depth, const CameraModel& camera) {
  RayTable rays;
  rays.build(camera);
  const int columns = (depth.width + kTileSize - 1) / kTileSize;
  const int rows = (depth.height + kTileSize - 1) / kTileSize;
  std::vector<Points> points(static_cast<std::size_t>(columns * rows));
  const DepthView view = depth.view();
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      const float z = metresAt(view, u, v);
      if (!(z >= 0.1F)) continue;
      const int tile = v / kTileSize * columns + u / kTileSize;
      points[static_cast<std::size_t>(tile)].push_back((z * rays.ray(u, v)).cast<double>());
    }
  }
  return points;
}

/// What there is to know of a tile's heights, in double and point by point.
struct Reference {
  double count, mean = 0.0, variance = 0.0, slope = 0.0;

  Reference(const Points& points, const HessePlane& plane)
      : count(static_cast<double>(points.size())) {
    if (points.empty()) return;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const auto& r : points) {
      mean += plane.signedDistance(r) / count;
      middle += r.head<2>() / count;
    }
    Eigen::Matrix2d a = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (const auto& r : points) {
      const double h = plane.signedDistance(r) - mean;
      const Eigen::Vector2d xy = r.head<2>() - middle;
      variance += h * h / count;
      a += xy * xy.transpose() / count;
      b += h * xy / count;
    }
    const Eigen::Vector2d slopes = a.ldlt().solve(b);
    for (const auto& r : points) slope += std::pow(slopes.dot(r.head<2>() - middle), 2) / count;
  }
};

/// The five conditions, each as what has to be positive, as a share of what it is compared with.
std::array<double, 5> margins(const Reference& tile, double gamma, double sigma, double level) {
  const double distance = std::abs(tile.mean);
  return {tile.count / 7.5 - 1.0, 1.0 - distance / gamma,
          1.0 - (distance + 2.0 * std::sqrt(tile.variance)) / gamma,
          1.0 - distance / (level * sigma), 1.0 - std::sqrt(tile.slope) / (0.85 * sigma)};
}

TileVerdict verdictOf(const std::array<double, 5>& margin) {
  if (margin[0] < 0.0 || margin[1] < 0.0 || margin[4] < 0.0) return TileVerdict::kOff;
  return margin[2] < 0.0 || margin[3] < 0.0 ? TileVerdict::kTouches : TileVerdict::kOnPlane;
}

/// A wavy, noisy ground with holes: tiles of every kind.
OwnedDepth<float> roughDepth(const CameraModel& camera, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  OwnedDepth<float> depth = planeDepth(camera, upOf(0.7, 0.2), 1.1);
  const int columns = (camera.width + 7) / 8;
  std::vector<std::array<double, 5>> kinds(
      static_cast<std::size_t>(columns * ((camera.height + 7) / 8)));
  for (auto& kind : kinds) {
    kind = {0.03 * uniform(generator) * uniform(generator), 0.02 * uniform(generator),
            0.02 * uniform(generator), 0.012 * std::pow(uniform(generator), 2),
            uniform(generator) > 0.5 ? 0.86 : 0.1};
  }
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const auto& [step, across, down, noise, holes] =
          kinds[static_cast<std::size_t>(v / 8 * columns + u / 8)];
      float& z = depth.at(u, v);
      z += static_cast<float>(step + across * (u % 8 - 3.5) / 3.5 + down * (v % 8 - 3.5) / 3.5 +
                              noise * gauss(generator));
      if (0.5 + 0.5 * uniform(generator) < holes) z = 0.0F;
    }
  }
  return depth;
}

struct Size {
  int width, height;
};
class TilePlaneKernelSize : public testing::TestWithParam<Size> {};

TEST_P(TilePlaneKernelSize, JudgesAsPointByPointArithmetic) {
  const CameraModel camera = testCamera(GetParam().width, GetParam().height);
  std::array<int, 5> decides{};
  std::size_t compared = 0, all = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const OwnedDepth<float> depth = roughDepth(camera, seed);
    const std::vector<Points> points = pointsOfTiles(depth, camera);
    TileScene scene(depth, camera);
    // Whole vectors can be read from any tile on.
    ASSERT_GE(scene.tiles.count.size(), points.size() + kTileSize - 1);
    const Eigen::Vector3d n = -upOf(0.7 + 0.004 * seed, 0.198);
    const HessePlane plane{n, 1.1 + 0.002 * seed};
    const PlaneTest test{PlaneFrame::of(plane, {0.1, 0.5, 1.3}), 1.4F};
    TileVerdicts verdicts;
    verdicts.resize(scene.tiles.count.size());
    runTilePlaneKernel(scene.tiles, scene.limits, test, 0, scene.tiles.size(), verdicts);
    for (std::size_t i = 0; i < scene.tiles.size(); ++i) {
      const Reference tile(points[i], plane);
      ++all;
      if (points[i].empty()) {
        ++compared;
        EXPECT_EQ(verdicts.verdict[i], TileVerdict::kOff);
        continue;
      }
      EXPECT_NEAR(verdicts.height[i], tile.mean, 1e-6) << i;
      const double square = tile.mean * tile.mean + tile.variance;
      const auto trace =
          static_cast<double>(scene.tiles.xx[i] + scene.tiles.yy[i] + scene.tiles.zz[i]);
      EXPECT_NEAR(verdicts.mean_square[i], square, 2e-8 + 1e-4 * square + 1e-5 * trace) << i;
      const double z = static_cast<double>(scene.tiles.z[i]), sigma = 0.002 + 1.425e-3 * z * z;
      const auto margin = margins(tile, 3.0 * sigma, sigma, 1.4);
      // Float may decide what is closer; a tile of few readings in a line has no slope that counts.
      if (std::any_of(margin.begin(), margin.end(), [](double m) { return std::abs(m) < 2e-3; })) {
        continue;
      }
      ++compared;
      EXPECT_EQ(verdicts.verdict[i], verdictOf(margin)) << i << ": " << tile.mean;
      const auto refused =
          std::count_if(margin.begin(), margin.end(), [](double m) { return m < 0.0; });
      for (std::size_t k = 0; k < 5; ++k) decides[k] += refused == 1 && margin[k] < 0.0;
    }
  }
  EXPECT_GT(compared, all * 9 / 10);
  if (GetParam().width < 100) return;
  // |mean| > gamma implies the two sigmas, and sooner or later the level.
  for (const std::size_t k : {0U, 2U, 3U, 4U}) EXPECT_GT(decides[k], 5) << k;
}
INSTANTIATE_TEST_SUITE_P(Sizes, TilePlaneKernelSize,
                         testing::Values(Size{640, 480}, Size{161, 121}, Size{9, 17}, Size{8, 8},
                                         Size{123, 77}));

TEST(TilePlaneKernel, JudgesARangeAndLeavesTheRest) {
  const CameraModel camera = testCamera(161, 121);
  TileScene scene(roughDepth(camera, 3), camera);
  const HessePlane plane{-upOf(0.7, 0.2), 1.1};
  const PlaneTest test{PlaneFrame::of(plane, {0.0, 0.5, 1.2}), kInfinity};
  TileVerdicts all;
  all.resize(scene.tiles.count.size());
  runTilePlaneKernel(scene.tiles, scene.limits, test, 0, scene.tiles.size(), all);
  for (const std::size_t begin : {0U, 5U, 21U, 100U}) {
    for (const std::size_t length : {1U, 7U, 8U, 9U, 21U}) {
      const std::size_t end = begin + length;
      TileVerdicts some;
      some.resize(scene.tiles.count.size());
      std::fill(some.verdict.begin(), some.verdict.end(), TileVerdict{77});
      std::fill(some.height.begin(), some.height.end(), -7.0F);
      runTilePlaneKernel(scene.tiles, scene.limits, test, begin, end, some);
      for (std::size_t i = 0; i < some.verdict.size(); ++i) {
        if (i >= end && i < end + kTileSize) continue;
        const bool inside = i >= begin && i < end;
        ASSERT_EQ(some.verdict[i], inside ? all.verdict[i] : TileVerdict{77}) << begin << " " << i;
        ASSERT_EQ(some.height[i], inside ? all.height[i] : -7.0F);
      }
    }
  }
}

/// A single tile by its moments; the plane is z = 1, sigma 3 mm and gamma 10 mm.
struct Tile {
  float count = 64.0F, z = 1.0F;
  float xx = 1e-4F, xy = 0.0F, xz = 0.0F, yy = 1e-4F, yz = 0.0F, zz = 1e-7F;

  TileVerdict judge(float level = kInfinity) const {
    TileMoments tiles;
    tiles.resize(kTileSize * 3, kTileSize);
    TileLimits limits;
    limits.set(tiles, GrowthThresholds());
    std::fill(limits.gamma.begin(), limits.gamma.end(), 0.010F);
    std::fill(limits.inverse_sigma.begin(), limits.inverse_sigma.end(), 1.0F / 0.003F);
    tiles.count[1] = count;
    tiles.z[1] = z;
    tiles.xx[1] = xx, tiles.xy[1] = xy, tiles.xz[1] = xz;
    tiles.yy[1] = yy, tiles.yz[1] = yz, tiles.zz[1] = zz;
    TileVerdicts verdicts;
    verdicts.resize(tiles.count.size());
    runTilePlaneKernel(tiles, limits, {PlaneFrame::of(facing(1.0), {0.0, 0.0, 1.0}), level}, 0, 3,
                       verdicts);
    EXPECT_EQ(verdicts.verdict[0], TileVerdict::kOff);
    EXPECT_EQ(verdicts.verdict[2], TileVerdict::kOff);
    return verdicts.verdict[1];
  }
};

TEST(TilePlaneKernel, AnEighthOfTheReadingsIsEnough) {
  Tile tile;
  tile.count = 8.0F;
  EXPECT_EQ(tile.judge(), TileVerdict::kOnPlane);
  tile.count = 7.0F;
  EXPECT_EQ(tile.judge(), TileVerdict::kOff);
}

TEST(TilePlaneKernel, TheMeanIsWithinGamma) {
  for (const float side : {-1.0F, 1.0F}) {
    Tile tile;
    tile.z = 1.0F + side * 0.00999F;
    EXPECT_EQ(tile.judge(), TileVerdict::kTouches);
    tile.z = 1.0F + side * 0.01001F;
    EXPECT_EQ(tile.judge(), TileVerdict::kOff);
    tile.z = 1.0F + side * 0.012F;  // far off, but within two sigmas squared
    EXPECT_EQ(tile.judge(), TileVerdict::kOff);
  }
}

TEST(TilePlaneKernel, TwoStandardDeviationsAreWithinGamma) {
  for (const float side : {-1.0F, 1.0F}) {
    Tile tile;
    tile.z = 1.0F + side * 0.004F;
    tile.zz = 0.00299F * 0.00299F;
    EXPECT_EQ(tile.judge(), TileVerdict::kOnPlane);
    tile.zz = 0.00301F * 0.00301F;
    EXPECT_EQ(tile.judge(), TileVerdict::kTouches);
  }
}

TEST(TilePlaneKernel, TheMeanIsWithinTheLevel) {
  for (const float side : {-1.0F, 1.0F}) {
    Tile tile;
    tile.z = 1.0F + side * 0.003F;
    EXPECT_EQ(tile.judge(1.01F), TileVerdict::kOnPlane);
    EXPECT_EQ(tile.judge(0.99F), TileVerdict::kTouches);
  }
}

TEST(TilePlaneKernel, TheSlopeIsBelowItsLimit) {
  const float limit = 0.85F * 0.003F;
  for (const float side : {-1.0F, 1.0F}) {
    for (const float share : {0.995F, 1.005F}) {
      const TileVerdict expected = share < 1.0F ? TileVerdict::kOnPlane : TileVerdict::kOff;
      Tile tile;
      tile.xz =
          side * share * limit * 0.01F;  // covariance with a length of standard deviation 1 cm
      tile.zz = 1.1F * limit * limit;
      EXPECT_EQ(tile.judge(), expected);
      std::swap(tile.xz, tile.yz);
      EXPECT_EQ(tile.judge(), expected);
      // Along x + y, where the tile is longer.
      tile.xy = 0.6e-4F;
      tile.xz = tile.yz = side * share * limit * std::sqrt(0.5F * 1.6e-4F);
      EXPECT_EQ(tile.judge(), expected);
      // Along x - y, where it is shorter.
      tile.xz = side * share * limit * std::sqrt(0.5F * 0.4e-4F);
      tile.yz = -tile.xz;
      EXPECT_EQ(tile.judge(), expected);
    }
  }
}

TEST(TilePlaneKernel, ReadingsInALineTellNoSlope) {
  Tile tile;
  tile.xz = 5e-5F;  // three times the limit, were it a slope
  tile.zz = 2.4e-5F;
  tile.yy = 0.0F;
  EXPECT_EQ(tile.judge(), TileVerdict::kOnPlane);
  std::swap(tile.xx, tile.yy);
  std::swap(tile.xz, tile.yz);
  EXPECT_EQ(tile.judge(), TileVerdict::kOnPlane);
  tile.xx = 1e-4F;
  tile.xy = 0.99999e-4F;
  EXPECT_EQ(tile.judge(), TileVerdict::kOnPlane);
  tile.xy = 0.0F;
  EXPECT_EQ(tile.judge(), TileVerdict::kOff);
  tile.xx = 1e-8F;  // narrow, but not a line
  EXPECT_EQ(tile.judge(), TileVerdict::kOff);
}

class ResidualKernel : public testing::TestWithParam<float> {};

TEST_P(ResidualKernel, SumsPointByPoint) {
  const float width = GetParam();
  const CameraModel camera = testCamera(192, 125);
  const OwnedDepth<float> depth = roughDepth(camera, 5);
  const std::vector<Points> points = pointsOfTiles(depth, camera);
  TileScene scene(depth, camera);
  const HessePlane plane{-upOf(0.7, 0.2), 1.1};
  for (const float level : {0.8F, kInfinity}) {
    const PlaneTest test{PlaneFrame::of(plane, {0.2, 0.4, 1.2}), level};
    scene.judgeBy(plane, level);
    std::vector<std::uint8_t> members(scene.tiles.count.size());
    for (std::size_t i = 0; i < members.size(); ++i) members[i] = i % 3 != 0;
    const Eigen::Matrix3d axes = test.frame.axes.cast<double>();
    Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    for (std::size_t i = 0; i < scene.tiles.size(); ++i) {
      if (!members[i] || !scene.judge.onPlane(i)) continue;
      Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      for (const auto& r : points[i]) centre += r / static_cast<double>(points[i].size());
      const double sigma = 0.002 + 1.425e-3 * centre.z() * centre.z();
      const double off = plane.signedDistance(centre) / sigma / static_cast<double>(width);
      const double weight = std::pow(1.0 + off * off, -2) / (sigma * sigma);
      const auto in_frame = [&](const Eigen::Vector3d& r) -> Eigen::Vector3d {
        return axes.transpose() * (r - test.frame.origin.cast<double>());
      };
      const Eigen::Vector3d c = in_frame(centre);
      const Eigen::Vector3d basis(c.x(), c.y(), 1.0);
      for (const auto& r : points[i]) {
        const Eigen::Vector3d p = in_frame(r);
        normal_matrix += weight * basis * basis.transpose();
        right += weight * p.z() * Eigen::Vector3d(p.x(), p.y(), 1.0);
      }
      count += points[i].size();
    }
    ASSERT_GT(count, 1000U);
    const PlaneResiduals sums = runResidualKernel(scene.tiles, scene.limits, test, width, members);
    EXPECT_EQ(sums.points, count);
    EXPECT_LT((sums.normal_matrix - normal_matrix).norm(), 1e-5 * normal_matrix.norm());
    // As heights that are all as far off as the noise would have it.
    const Eigen::Vector3d scale = normal_matrix.diagonal().cwiseSqrt() * std::sqrt(count) * 1e-3;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(sums.right[k], right[k], 2e-3 * scale[k]) << k;
    EXPECT_GT(right.cwiseAbs().minCoeff(), 0.0);
  }
}
INSTANTIATE_TEST_SUITE_P(Widths, ResidualKernel, testing::Values(0.35F, 1.0F, kInfinity));

TEST(ResidualKernel, WithoutMembersThereIsNothing) {
  const CameraModel camera = testCamera(160, 120);
  const TileScene scene(planeDepth(camera, upOf(1.0), 1.0), camera);
  const PlaneTest test{PlaneFrame::of({-upOf(1.0), 1.0}, {0.0, 0.0, 1.0}), kInfinity};
  const PlaneResiduals none = runResidualKernel(scene.tiles, scene.limits, test, kInfinity,
                                                std::vector<std::uint8_t>(scene.taken.size(), 0));
  EXPECT_EQ(none.points, 0U);
  EXPECT_EQ(none.normal_matrix, Eigen::Matrix3d::Zero());
  EXPECT_EQ(none.right, Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace dominant_plane_detection
