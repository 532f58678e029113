#include "core/grid_search.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "core/label_rule.h"
#include "support/tile_scene.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = M_PI / 180.0;

/// What a search came to.
struct Result {
  PlaneSelection selection;
  Effort effort;
  std::vector<std::uint8_t> ground;
  bool tracked = false;

  std::size_t tiles() const {
    return static_cast<std::size_t>(std::accumulate(ground.begin(), ground.end(), 0));
  }
};

template <typename Pixel>
Result search(const OwnedDepth<Pixel>& depth, const CameraModel& camera,
              const Parameters& parameters = {}, std::size_t min_points = 500,
              const std::optional<HessePlane>& predicted = std::nullopt) {
  const TileScene scene(depth, camera);
  Result result{PlaneSelection({parameters.expected_up.normalized(), parameters.max_tilt,
                                parameters.min_height, parameters.max_height, min_points}),
                {},
                {}};
  GridSearch grid;
  grid.run({scene.tiles, camera, 100}, parameters, predicted, result.selection, result.effort);
  if (result.selection.found()) result.ground = grid.ground();
  result.tracked = grid.tracked();
  return result;
}

const CameraModel kCamera = testCamera(320, 240);

HessePlane ground(double pitch, double height) { return {-upOf(pitch), height}; }

OwnedDepth<float> everywhere(const HessePlane& plane) {
  OwnedDepth<float> depth(kCamera.width, kCamera.height);
  paintTiles(depth, kCamera, plane, [](int, int) { return true; });
  return depth;
}

/// Whatever the region was grown from, the plane is the least squares fit of its tiles.
TEST(GridSearch, ThePlaneIsFittedToItsTiles) {
  const HessePlane floor = ground(0.9, 1.0);
  OwnedDepth<float> depth = everywhere(floor);
  addNoise(
      depth, [](double z) { return 1e-3 * z * z; }, 4);
  const Result result = search(depth, kCamera);
  ASSERT_TRUE(result.selection.found());
  const TileScene scene(depth, kCamera);
  PlaneMoments moments;
  for (std::size_t tile = 0; tile < scene.tiles.size(); ++tile) {
    if (!result.ground[tile]) continue;
    const double sigma = NoiseModel().sigma(static_cast<double>(scene.tiles.z[tile]));
    moments.add(static_cast<double>(scene.tiles.count[tile]), scene.tiles.centre(tile),
                scene.tiles.scatter(tile), 1.0 / (sigma * sigma));
  }
  EXPECT_LT(angleBetween(result.selection.plane(), moments.fit()->plane), 2e-5);
  EXPECT_NEAR(result.selection.plane().distance, moments.fit()->plane.distance, 2e-5);
}

/// Once the floor has more than all the rest no seed is tried any more.
TEST(GridSearch, EndsWhenNothingLargerCanBeLeft) {
  const HessePlane floor = ground(0.9, 1.0);
  OwnedDepth<float> depth = everywhere(floor);
  paintTiles(depth, kCamera, facing(1.5), [](int, int row) { return row < 12; });
  const Result result = search(depth, kCamera);
  ASSERT_TRUE(result.selection.found());
  EXPECT_NEAR(static_cast<double>(result.tiles()), 18.0 * 40.0, 80.0);
  EXPECT_LE(result.effort.seeds, 3U);
}

TEST(GridSearch, AFullFloorIsFoundAtOnce) {
  const HessePlane floor = ground(0.9, 1.0);
  const Result result = search(everywhere(floor), kCamera);
  ASSERT_TRUE(result.selection.found());
  EXPECT_LT(angleBetween(result.selection.plane(), floor), 1e-4);
  EXPECT_NEAR(result.selection.plane().distance, 1.0, 1e-4);
  EXPECT_EQ(result.selection.points(), 320U * 240U);
  EXPECT_EQ(result.tiles(), 1200U);
  EXPECT_LE(result.effort.seeds, 3U);  // the first may be a corner
  EXPECT_EQ(result.effort.regions, 1U);
  EXPECT_EQ(result.effort.joined, 2U * 1200U);  // grown, and collected on its final plane
  EXPECT_GE(result.effort.tests, 1200U - 9U);
  EXPECT_LE(result.effort.tests, 2U * 1200U);
  // Those of the seed and of the growth, two that look for the surface and one of the final plane.
  const TileScene scene(everywhere(floor), kCamera);
  TileJudge judge;
  judge.start(scene.tiles, scene.limits);
  TileGrowth growth;
  growth.start(scene.tiles, scene.tile_angle);
  growth.grow(judge, *fitSeed(judge, scene.taken, scene.at(20, 15)), scene.taken);
  EXPECT_NEAR(static_cast<double>(result.effort.fits),
              static_cast<double>(result.effort.seeds + growth.fits() + 3), 1.0);
}

TEST(GridSearch, TheLargerOfTwoGroundsWinsWhateverTheSeeds) {
  const HessePlane floor = ground(0.9, 1.0), table = ground(0.9, 0.7);
  for (const bool larger_left : {false, true}) {
    OwnedDepth<float> depth = everywhere(floor);
    paintTiles(depth, kCamera, table,
               [&](int column, int) { return larger_left ? column >= 24 : column < 24; });
    Parameters parameters;
    for (parameters.random_seed = 0; parameters.random_seed < 20; ++parameters.random_seed) {
      const Result result = search(depth, kCamera, parameters);
      ASSERT_TRUE(result.selection.found());
      EXPECT_NEAR(result.selection.plane().distance, larger_left ? 1.0 : 0.7, 1e-3);
      EXPECT_EQ(result.tiles(), 720U);
      for (int row = 0; row < 30; ++row) {
        EXPECT_EQ(result.ground[static_cast<std::size_t>(row * 40 + 5)], 1);
        EXPECT_EQ(result.ground[static_cast<std::size_t>(row * 40 + 35)], 0);
      }
    }
  }
}

/// A square plate before a camera 0.6 m up, with a Kinect's noise; rays by own arithmetic.
struct Plate {
  double height;  ///< [m]
  double ahead;   ///< [m]
  unsigned seed;

  OwnedDepth<std::uint16_t> depth(const CameraModel& camera, double pitch) const {
    OwnedDepth<std::uint16_t> depth(camera.width, camera.height);
    std::mt19937 generator(seed);
    std::normal_distribution<double> gauss;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
        const double down = std::sin(pitch) + y * std::cos(pitch);
        const double forward = std::cos(pitch) - y * std::sin(pitch);
        if (down <= 0.0) continue;
        const auto on_plate = [&](double z) {
          return z * forward >= ahead && z * forward <= ahead + 0.8 && std::abs(z * x) <= 0.4;
        };
        const double on_top = (0.6 - height) / down, on_floor = 0.6 / down;
        const double front = ahead / forward;
        double z = on_floor;
        if (on_plate(on_top)) {
          z = on_top;
        } else if (front * down > 0.6 - height && front * down < 0.6 &&
                   std::abs(front * x) <= 0.4) {
          z = front;
        }
        z += (0.002 + 1.425e-3 * z * z) * gauss(generator);
        if (z > 0.5 && z < 4.0) depth.at(u, v) = static_cast<std::uint16_t>(std::lround(1e3 * z));
      }
    }
    return depth;
  }
};

TEST(GridSearch, APlateAndAFloorAreNotOne) {
  const CameraModel camera = testCamera();
  const double pitch = 0.45;
  for (const double height : {0.015, 0.025, 0.040}) {
    for (const unsigned seed : {1U, 2U}) {
      const Plate plate{height, seed == 1 ? 0.8 : 1.0, seed};
      const Result result = search(plate.depth(camera, pitch), camera);
      ASSERT_TRUE(result.selection.found());
      const HessePlane& plane = result.selection.plane();
      EXPECT_LT(angleBetween(plane, ground(pitch, 0.6)), 0.3 * kDegree) << height;
      EXPECT_NEAR(plane.distance, 0.6, 5e-3) << height;
    }
  }
}

TEST(GridSearch, UpsideDownItIsTheSame) {
  const HessePlane floor = ground(0.5, 0.8);
  OwnedDepth<float> depth(kCamera.width, kCamera.height);
  paintTiles(depth, kCamera, floor, [](int, int row) { return row > 8; });
  paintTiles(depth, kCamera, facing(2.5), [](int, int row) { return row <= 8; });
  OwnedDepth<float> turned = depth;
  std::reverse(turned.pixels.begin(), turned.pixels.end());
  Parameters parameters;
  const Result upright = search(depth, kCamera, parameters);
  parameters.expected_up = {0.0, 1.0, 0.0};
  const Result upside_down = search(turned, kCamera, parameters);
  ASSERT_TRUE(upright.selection.found() && upside_down.selection.found());
  EXPECT_EQ(upright.selection.points(), upside_down.selection.points());
  EXPECT_EQ(upright.tiles(), upside_down.tiles());
  EXPECT_GT(upright.tiles(), 800U);
  EXPECT_NEAR(upside_down.selection.plane().distance, 0.8, 1e-3);
}

TEST(GridSearch, AWallIsTooTiltedAndTheBudgetIsKept) {
  Parameters parameters;
  parameters.seeds = 12;
  const Result result = search(everywhere(facing(2.0)), kCamera, parameters);
  EXPECT_FALSE(result.selection.found());
  EXPECT_EQ(result.selection.refusal(), State::kTooTilted);
  EXPECT_LE(result.effort.seeds, 2U * 12U);
  EXPECT_EQ(result.effort.regions, 1U);  // the wall, to tell why
}

TEST(GridSearch, SaysWhyAGroundIsRefused) {
  OwnedDepth<float> depth(kCamera.width, kCamera.height);
  paintTiles(depth, kCamera, ground(0.9, 1.0), [](int c, int r) { return c < 8 && r < 8; });
  Parameters parameters;
  EXPECT_TRUE(search(depth, kCamera, parameters, 64 * 64).selection.found());
  // Near to what is required and finished, or far from it and given up.
  for (const std::size_t required : {64U * 64U + 1U, 4U * 64U * 64U}) {
    const Result small = search(depth, kCamera, parameters, required);
    EXPECT_FALSE(small.selection.found());
    EXPECT_EQ(small.selection.refusal(), State::kTooSmall);
    // Finished regions are counted twice: as grown, and as collected.
    EXPECT_EQ(small.effort.joined, (required < 5000U ? 2U : 1U) * 64U * small.effort.regions);
  }
  parameters.max_height = 0.9;
  const Result high = search(depth, kCamera, parameters);
  EXPECT_FALSE(high.selection.found());
  EXPECT_EQ(high.selection.refusal(), State::kOutOfHeightRange);
}

TEST(GridSearch, WhereNoPlaneIsAllSeedsAreTried) {
  OwnedDepth<float> depth = everywhere(facing(2.0));
  addNoise(
      depth, [](double) { return 0.3; }, 1);
  Parameters parameters;
  parameters.seeds = 17;
  const Result result = search(depth, kCamera, parameters);
  EXPECT_FALSE(result.selection.found());
  EXPECT_EQ(result.effort.seeds, 2U * 17U);
  EXPECT_EQ(result.effort.regions, 0U);
  EXPECT_EQ(result.effort.joined, 0U);
  EXPECT_EQ(result.effort.fits, 2U * 17U);
}

TEST(GridSearch, WithoutReadingsThereIsNoSeed) {
  const Result result = search(OwnedDepth<float>(320, 240), kCamera);
  EXPECT_FALSE(result.selection.found());
  EXPECT_EQ(result.effort.seeds, 0U);
  EXPECT_EQ(result.effort.fits, 0U);
}

/// A wall beside a ground: its seeds take their tiles and grow nothing.
TEST(GridSearch, AWallDoesNotHideTheGround) {
  const HessePlane floor = ground(0.9, 1.0);
  OwnedDepth<float> depth = everywhere(facing(3.0));
  paintTiles(depth, kCamera, floor, [](int column, int row) { return row < 12 && column > 10; });
  Parameters parameters;
  for (parameters.random_seed = 0; parameters.random_seed < 5; ++parameters.random_seed) {
    const Result result = search(depth, kCamera, parameters);
    ASSERT_TRUE(result.selection.found());
    EXPECT_EQ(result.tiles(), 12U * 29U);
    EXPECT_EQ(result.selection.points(), 12U * 29U * 64U);
    EXPECT_LT(angleBetween(result.selection.plane(), floor), 1e-4);
  }
}

/// A step of 9 mm, within gamma: the smaller part is told from the ground, and on which side of it;
/// in the next image, smaller and without a step, there is no other surface.
TEST(GridSearch, AnotherLevelIsNoGround) {
  GridSearch grid;
  const auto run = [&grid](const OwnedDepth<float>& depth, const CameraModel& camera) {
    const TileScene scene(depth, camera);
    PlaneSelection selection({-Eigen::Vector3d::UnitY(), 1.05, 0.0, 10.0, 500});
    Effort effort;
    grid.run({scene.tiles, camera, 100}, {}, std::nullopt, selection, effort);
    return selection;
  };
  for (const double step : {0.009, -0.009}) {
    OwnedDepth<float> depth = everywhere(ground(0.9, 1.0));
    paintTiles(depth, kCamera, ground(0.9, 1.0 - step),
               [](int column, int) { return column < 12; });
    const PlaneSelection selection = run(depth, kCamera);
    ASSERT_TRUE(selection.found());
    EXPECT_NEAR(selection.plane().distance, 1.0, 0.001);
    int ground_tiles = 0, other_tiles = 0;
    for (std::size_t tile = 0; tile < 40U * 30U; ++tile) {
      const std::uint8_t other = grid.otherSurfaces()[tile];
      EXPECT_FALSE(grid.ground()[tile] && other);
      ground_tiles += grid.ground()[tile];
      other_tiles += other == (step > 0.0 ? kAbove : kBelow);
      EXPECT_TRUE(other == 0 || other == (step > 0.0 ? kAbove : kBelow));
    }
    EXPECT_NEAR(ground_tiles, 28 * 30, 2 * 30);
    EXPECT_NEAR(other_tiles, 12 * 30, 2 * 30);
  }
  const CameraModel small = testCamera(160, 120);
  OwnedDepth<float> flat(small.width, small.height);
  paintTiles(flat, small, ground(0.9, 1.0), [](int, int) { return true; });
  ASSERT_TRUE(run(flat, small).found());
  for (std::size_t tile = 0; tile < 20U * 15U; ++tile) {
    EXPECT_EQ(grid.otherSurfaces()[tile], 0U);
    EXPECT_EQ(grid.ground()[tile], 1U);
  }
}

/// Two levels within gamma, about half of the image each, one of them at the camera's foot: it is
/// the ground although the other one has some more tiles.
TEST(GridSearch, OfLikeLevelsTheNearerOneWins) {
  const auto near = [](int, int row) { return row >= 16; };
  Parameters parameters;
  parameters.smooth_error = {0.0003, 0.0002};
  for (const double step : {0.006, -0.006}) {
    OwnedDepth<float> depth = everywhere(ground(0.9, 1.0 - step));
    paintTiles(depth, kCamera, ground(0.9, 1.0), near);
    const Result result = search(depth, kCamera, parameters);
    ASSERT_TRUE(result.selection.found());
    EXPECT_NEAR(result.selection.plane().distance, 1.0, 0.002) << step;
  }
}

TEST(GridSearch, PiecesBeyondAGapJoinAndTurnThePlane) {
  const HessePlane floor = ground(0.9, 1.0);
  OwnedDepth<float> depth = everywhere(floor);
  eraseTiles(depth, [](int column, int) { return column >= 20 && column < 26; });
  Parameters parameters;
  const Result joined = search(depth, kCamera, parameters);
  ASSERT_TRUE(joined.selection.found());
  EXPECT_EQ(joined.tiles(), 34U * 30U);
  EXPECT_EQ(joined.selection.points(), 34U * 30U * 64U);
  parameters.join_pieces = false;
  const Result alone = search(depth, kCamera, parameters);
  ASSERT_TRUE(alone.selection.found());
  EXPECT_EQ(alone.tiles(), 20U * 30U);
  EXPECT_EQ(alone.selection.points(), 20U * 30U * 64U);
  // A piece 8 mm lower: its plane is between, nearer to the larger part.
  paintTiles(depth, kCamera, ground(0.9, 1.002), [](int column, int) { return column >= 26; });
  parameters.join_pieces = true;
  const Result between = search(depth, kCamera, parameters);
  ASSERT_TRUE(between.selection.found());
  EXPECT_GT(between.selection.points(), 20U * 30U * 64U);
}

/// A comb of floor before what is farther and lies on nothing: less than half of its hull is
/// filled.
TEST(GridSearch, StripesAreNoGround) {
  const HessePlane floor = ground(0.9, 1.0);
  for (const int gap : {3, 8}) {
    OwnedDepth<float> depth = everywhere(floor);
    std::mt19937 generator(2);
    std::uniform_real_distribution<float> farther(1.3F, 1.9F);
    for (int v = 0; v < kCamera.height; ++v) {
      for (int u = 0; u < kCamera.width; ++u) {
        const int column = u / 8, row = v / 8;
        const bool comb = (row >= 14 && row < 17) || column % (3 + gap) < 3;
        if (!comb) depth.at(u, v) *= farther(generator);
      }
    }
    const Result result = search(depth, kCamera);
    EXPECT_EQ(result.selection.found(), gap == 3) << gap;
    if (gap == 8) {
      EXPECT_EQ(result.selection.refusal(), State::kNoRegion);
    }
  }
}

/// The top of a ball, seen from above, has a cap within gamma of a plane; that of a flat disc does
/// not bend.
TEST(GridSearch, TheCapOfABallIsNoGround) {
  Parameters parameters;
  parameters.expected_up = {0.0, 0.0, -1.0};
  for (const bool ball : {true, false}) {
    constexpr double kRadius = 0.5;  // [m]
    OwnedDepth<float> depth(kCamera.width, kCamera.height);
    for (int v = 0; v < kCamera.height; ++v) {
      for (int u = 0; u < kCamera.width; ++u) {
        const Eigen::Vector2d ray = kCamera.ray({u, v});
        // On (z rx)^2 + (z ry)^2 + (z - 1.5)^2 = R^2, the near side.
        const double a = ray.squaredNorm() + 1.0, c = 1.5 * 1.5 - kRadius * kRadius;
        const double root = 1.5 * 1.5 - a * c;
        if (root < 0.0) continue;
        depth.at(u, v) = ball ? static_cast<float>((1.5 - std::sqrt(root)) / a) : 1.0F;
      }
    }
    // A cap of 2,000 pixels is 12 cm wide and bends by 14 degrees; one of 500 might be noise.
    EXPECT_EQ(search(depth, kCamera, parameters, 2000).selection.found(), !ball);
  }
}

/// No tile lies on the plane: nothing is left of an earlier image.
TEST(GridSearch, APlaneThatNothingLiesOnHasNoGround) {
  const OwnedDepth<float> depth = everywhere(ground(0.9, 1.0));
  const TileScene scene(depth, kCamera);
  GridSearch grid;
  grid.collectGround({scene.tiles, kCamera, 100}, {}, ground(0.9, 1.0), {scene.at(5, 20)});
  EXPECT_EQ(std::count(grid.ground().begin(), grid.ground().end(), 1), 1200);
  grid.collectGround({scene.tiles, kCamera, 100}, {}, ground(0.9, 0.5), {scene.at(5, 20)});
  EXPECT_EQ(grid.ground().size(), scene.tiles.count.size());
  EXPECT_EQ(std::count(grid.ground().begin(), grid.ground().end(), 1), 0);
}

TEST(GridSearch, CollectsTheGroundOfAPlane) {
  const HessePlane floor = ground(0.9, 1.0);
  OwnedDepth<float> depth = everywhere(floor);
  eraseTiles(depth, [](int column, int) { return column >= 20 && column < 26; });
  paintTiles(depth, kCamera, ground(0.9, 0.8),
             [](int column, int row) { return row < 3 && column < 20; });
  const TileScene scene(depth, kCamera);
  // Points of it in a few tiles, one of them on something else.
  const std::vector<std::size_t> region = {scene.at(5, 10), scene.at(9, 20), scene.at(5, 1)};
  GridSearch grid;
  Parameters parameters;
  for (const bool join : {true, false}) {
    parameters.join_pieces = join;
    grid.collectGround({scene.tiles, kCamera, 100}, parameters, floor, region);
    for (int row = 0; row < 30; ++row) {
      for (int column = 0; column < 40; ++column) {
        const bool left = column < 20 && row >= 3, right = column >= 26;
        EXPECT_EQ(grid.ground()[scene.at(column, row)], left || (right && join)) << column;
      }
    }
  }
}

/// A floor with a table over two fifths of the image.
OwnedDepth<float> floorWithTables() {
  OwnedDepth<float> depth = everywhere(ground(0.9, 1.0));
  paintTiles(depth, kCamera, ground(0.9, 0.6), [](int column, int) { return column >= 24; });
  return depth;
}

TEST(GridSearch, WhatIsPredictedRightlyTakesNoSearch) {
  const OwnedDepth<float> depth = floorWithTables();
  const Result searched = search(depth, kCamera);
  EXPECT_FALSE(searched.tracked);
  // Half a degree and 5 mm off.
  const Result followed = search(depth, kCamera, {}, 500, ground(0.9 + 0.5 * kDegree, 1.005));
  EXPECT_TRUE(followed.tracked);
  EXPECT_EQ(followed.effort.seeds, 1U);
  EXPECT_EQ(followed.effort.tests, 0U);  // nothing is grown
  EXPECT_EQ(followed.ground, searched.ground);
  EXPECT_LT(angleBetween(followed.selection.plane(), searched.selection.plane()), 1e-6);
  EXPECT_NEAR(followed.selection.plane().distance, searched.selection.plane().distance, 1e-6);
}

TEST(GridSearch, WhatIsPredictedWronglyLosesToWhatIsThere) {
  const OwnedDepth<float> depth = floorWithTables();
  const Result searched = search(depth, kCamera);
  // The smaller plane, none at all, one that crosses both.
  for (const HessePlane& wrong : {ground(0.9, 0.6), ground(0.9, 1.5), ground(0.3, 1.0)}) {
    const Result followed = search(depth, kCamera, {}, 500, wrong);
    EXPECT_FALSE(followed.tracked);
    EXPECT_EQ(followed.ground, searched.ground);
    EXPECT_NEAR(followed.selection.plane().distance, 1.0, 1e-4);
  }
}

/// A floor with a fold across the middle of the view, as a ramp's foot or a sensor's error makes
/// one.
/// @return [#] tiles of surfaces beside the ground.
std::size_t tilesBesideFold(double fold) {
  const HessePlane near = ground(0.9, 1.0);
  const Eigen::Vector3d ray = kCamera.ray({160.0, 120.0}).homogeneous();
  const Eigen::Vector3d on_fold = near.distance / near.normal.dot(ray) * ray;
  const Eigen::Vector3d normal = Eigen::AngleAxisd(fold, Eigen::Vector3d::UnitX()) * near.normal;
  OwnedDepth<float> depth = everywhere(near);
  paintTiles(depth, kCamera, {normal, normal.dot(on_fold)}, [](int, int row) { return row < 15; });
  addNoise(
      depth, [](double z) { return 2e-4 * z * z; }, 1);
  Parameters parameters;
  parameters.smooth_error = {0.0002, 0.0001};
  const TileScene scene(depth, kCamera);
  PlaneSelection selection({parameters.expected_up.normalized(), 1.0, 0.0, 10.0, 500});
  Effort effort;
  GridSearch grid;
  grid.run({scene.tiles, kCamera, 100}, parameters, std::nullopt, selection, effort);
  EXPECT_TRUE(selection.found());
  EXPECT_LT(angleBetween(selection.plane(), near), 0.3 * kDegree + std::abs(fold));
  // Either side is told from the other, whatever becomes of it.
  EXPECT_LT(selection.points(), 320U * 240U * 3 / 4);
  return scene.tiles.size() -
         static_cast<std::size_t>(std::count(
             grid.otherSurfaces().begin(),
             grid.otherSurfaces().begin() + static_cast<std::ptrdiff_t>(scene.tiles.size()),
             std::uint8_t{0}));
}

TEST(GridSearch, AFoldAsSmallAsTheNoiseIsNoOtherSurface) {
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(tilesBesideFold(sign * 0.5 * kDegree), 0U);
    EXPECT_GT(tilesBesideFold(sign * 2.0 * kDegree), 200U);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
