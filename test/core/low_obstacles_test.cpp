#include "core/low_obstacles.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/label_kernel.h"
#include "core/local_ground.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

constexpr double kCameraHeight = 0.7;  // [m]
const Eigen::Vector3d kUp = upOf(0.5);

/// The depth image of a floor that is as high at each place as a function says; `forward` is the
/// distance along the floor from below the camera, `right` across it.
OwnedDepth<float> floorWith(const std::function<double(double right, double forward)>& height) {
  const CameraModel camera = testCamera();
  OwnedDepth<float> depth = planeDepth(camera, kUp, kCameraHeight);
  const Eigen::Vector3d ahead = (Eigen::Vector3d::UnitZ() - kUp.z() * kUp).normalized();
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double z = static_cast<double>(depth.at(u, v));
      if (z == 0.0) continue;
      const Eigen::Vector3d floor = z * camera.ray({u, v}).homogeneous();
      // Low things seen from above: the ray meets them where it meets the floor, but for a little.
      const double h = height(floor.x(), ahead.dot(floor));
      depth.at(u, v) = static_cast<float>(z * (kCameraHeight - h) / kCameraHeight);
    }
  }
  return depth;
}

bool isIn(double value, double low, double high) { return value >= low && value < high; }

/// 20 cm wide and long, 1.2 m ahead.
double box(double right, double forward, double height) {
  return isIn(right, -0.1, 0.1) && isIn(forward, 1.1, 1.3) ? height : 0.0;
}

/// What the pixels over a place are labelled.
struct Shares {
  double ground = 0.0, obstacle = 0.0, unknown = 0.0;
};

Shares sharesWhere(const Detection& detection, const OwnedDepth<float>& depth,
                   const std::function<bool(double right, double forward)>& inside) {
  const CameraModel camera = testCamera();
  const Eigen::Vector3d ahead = (Eigen::Vector3d::UnitZ() - kUp.z() * kUp).normalized();
  Shares shares;
  double all = 0.0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.ray({u, v}).homogeneous();
      const double down = -kUp.dot(ray);
      if (down <= 0.0) continue;
      const Eigen::Vector3d floor = kCameraHeight / down * ray;
      if (!inside(floor.x(), ahead.dot(floor))) continue;
      const double z = static_cast<double>(depth.pixels[static_cast<std::size_t>(v * 640 + u)]);
      if (z < 0.5 || z > 4.0) continue;
      const Label label = detection.label(u, v);
      shares.ground += label == Label::kGround;
      shares.obstacle += label == Label::kObstacle;
      shares.unknown += label == Label::kUnknown;
      ++all;
    }
  }
  return {shares.ground / all, shares.obstacle / all, shares.unknown / all};
}

Detection detectIn(const OwnedDepth<float>& depth, const Parameters& parameters = {}) {
  return DominantPlaneDetector(parameters).detect(depth.view(), testCamera());
}

const auto kOnBox = [](double right, double forward) { return box(right, forward, 1.0) > 0.0; };

TEST(LowObstacles, ABoxOfTwoCentimetresIsSeenAndItsSurroundingsAreGround) {
  const auto depth = floorWith([](double x, double y) { return box(x, y, 0.02); });
  const Detection detection = detectIn(depth);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_NEAR(detection.distance, kCameraHeight, 0.0005);
  EXPECT_GT(sharesWhere(detection, depth, kOnBox).obstacle, 0.95);
  const auto apart = [](double x, double y) {
    return !(isIn(x, -0.15, 0.15) && isIn(y, 1.0, 1.4)) && isIn(x, -0.4, 0.4) && isIn(y, 0.6, 2.0);
  };
  EXPECT_EQ(sharesWhere(detection, depth, apart).ground, 1.0);
}

TEST(LowObstacles, WithoutARateTheBandAloneDecides) {
  const auto depth = floorWith([](double x, double y) { return box(x, y, 0.02); });
  Parameters parameters;
  parameters.false_alarm_rate = 0.0;
  EXPECT_EQ(sharesWhere(detectIn(depth, parameters), depth, kOnBox).obstacle, 0.0);
}

TEST(LowObstacles, WhatIsLowerThanTheLowestIsNoObstacle) {
  const auto depth = floorWith([](double x, double y) { return box(x, y, 0.02); });
  Parameters parameters;
  parameters.min_obstacle_height = 0.03;
  EXPECT_EQ(sharesWhere(detectIn(depth, parameters), depth, kOnBox).obstacle, 0.0);
}

/// 6 cm wide and long.
TEST(LowObstacles, WhatIsNarrowerThanTheNarrowestIsNoObstacle) {
  const auto kOnIt = [](double x, double y) { return isIn(x, -0.03, 0.03) && isIn(y, 1.1, 1.16); };
  const auto depth = floorWith([&](double x, double y) { return kOnIt(x, y) ? 0.02 : 0.0; });
  EXPECT_EQ(sharesWhere(detectIn(depth), depth, kOnIt).obstacle, 0.0);
  Parameters parameters;
  parameters.min_obstacle_width = 0.05;
  EXPECT_GT(sharesWhere(detectIn(depth, parameters), depth, kOnIt).obstacle, 0.9);
}

/// A box whose left and right sides slope by a third, less steeply than a face.
TEST(LowObstacles, WhatIsNeitherOnItNorOnTheGroundIsUnknown) {
  const auto height = [](double x, double y) {
    return isIn(y, 1.08, 1.32) ? 0.02 * std::clamp((0.12 - std::abs(x)) / 0.06, 0.0, 1.0) : 0.0;
  };
  const auto depth = floorWith(height);
  const Detection detection = detectIn(depth);
  const auto between = [&](double low, double high) {
    return sharesWhere(detection, depth, [&](double x, double y) {
      return isIn(y, 1.1, 1.3) && isIn(height(x, y), low, high);
    });
  };
  // The blocks about are up to 18 mm high: it belongs to the box from 0.4 of that on, and to the
  // ground up to 0.2.
  EXPECT_EQ(between(0.0075, 0.1).obstacle, 1.0);
  EXPECT_GT(between(0.004, 0.0065).unknown, 0.4);
  EXPECT_EQ(between(0.004, 0.0065).ground, 0.0);
  EXPECT_EQ(between(0.001, 0.003).ground, 1.0);
}

/// What became something else is taken from the ground's count, in each image anew.
TEST(LowObstacles, InliersAreTheGroundPixels) {
  const auto depth = floorWith([](double x, double y) { return box(x, y, 0.02); });
  DominantPlaneDetector detector;
  for (int image = 0; image < 2; ++image) {
    const Detection& detection = detector.detect(depth.view(), testCamera());
    const auto ground = std::count(detection.labels.begin(), detection.labels.end(),
                                   static_cast<std::uint8_t>(Label::kGround));
    EXPECT_EQ(detection.inliers, static_cast<std::size_t>(ground));
  }
}

/// For a sensor without any local error the box is high; it is within 0.75 sigma(z) all the same.
TEST(LowObstacles, WhatIsOnThePlaneIsNoObstacle) {
  Parameters parameters;
  parameters.local_error = {0.00001, 0.0};
  parameters.min_obstacle_height = 0.001;
  const auto low = floorWith([](double x, double y) { return box(x, y, 0.003); });
  EXPECT_EQ(sharesWhere(detectIn(low, parameters), low, kOnBox).ground, 1.0);
  const auto high = floorWith([](double x, double y) { return box(x, y, 0.006); });
  EXPECT_GT(sharesWhere(detectIn(high, parameters), high, kOnBox).obstacle, 0.95);
}

/// The wave is a third as high as the box, which the plane alone does not tell from the noise.
TEST(LowObstacles, AWaveOfTheSensorIsGroundAndABoxOnItIsSeen) {
  const auto wave = [](double x, double y) {
    return 0.003 * std::sin(6.0 * x) * std::cos(5.0 * y);
  };
  const auto depth = floorWith([&](double x, double y) { return wave(x, y) + box(x, y, 0.02); });
  const Detection detection = detectIn(depth);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_GT(sharesWhere(detection, depth, kOnBox).obstacle, 0.9);
  const auto apart = [](double x, double y) {
    return !(isIn(x, -0.15, 0.15) && isIn(y, 1.0, 1.4)) && isIn(x, -0.4, 0.4) && isIn(y, 0.6, 2.0);
  };
  EXPECT_GT(sharesWhere(detection, depth, apart).ground, 0.999);
}

/// A plate of 22 mm from side to side, 7 cm long: an obstacle, unless it is the foot of a wall,
/// where a camera smears depth.
TEST(LowObstacles, NothingIsSaidNextToWhatIsTall) {
  const auto plate = [](double y) { return isIn(y, 1.50, 1.57) ? 0.022 : 0.0; };
  const auto onPlate = [&](double x, double y) { return isIn(x, -0.3, 0.3) && plate(y) > 0.0; };
  const auto alone = floorWith([&](double, double y) { return plate(y); });
  EXPECT_GT(sharesWhere(detectIn(alone), alone, onPlate).obstacle, 0.9);
  const auto wall = floorWith([&](double, double y) { return y >= 1.57 ? 0.3 : plate(y); });
  const Detection detection = detectIn(wall);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_EQ(sharesWhere(detection, wall, onPlate).obstacle, 0.0);
  const auto foot = [](double x, double y) { return isIn(x, -0.3, 0.3) && isIn(y, 1.53, 1.565); };
  EXPECT_EQ(sharesWhere(detection, wall, foot).unknown, 1.0);
  const auto ground = std::count(detection.labels.begin(), detection.labels.end(),
                                 static_cast<std::uint8_t>(Label::kGround));
  EXPECT_EQ(detection.inliers, static_cast<std::size_t>(ground));
}

/// A ramp of 4 degrees, 1.2 m wide, which leaves the band 35 cm from its beginning. From where it
/// is off the plane by 2.5 sigma(z), half as far, it hangs together with what is beyond the band,
/// and is no ground.
TEST(LowObstacles, TheFootOfARampIsNoGround) {
  const auto on_ramp = [](double x, double y) { return isIn(x, -0.6, 0.6) && isIn(y, 1.2, 2.0); };
  const auto depth =
      floorWith([&](double x, double y) { return on_ramp(x, y) ? 0.07 * (y - 1.2) : 0.0; });
  const auto foot = [](double x, double y) { return isIn(x, -0.3, 0.3) && isIn(y, 1.38, 1.46); };
  const Detection detection = detectIn(depth);
  ASSERT_TRUE(detection.found());
  EXPECT_LT(sharesWhere(detection, depth, foot).ground, 0.1);
}

/// Adds a height of one local error that is the same in each tile of 8 pixels.
void addTileErrors(const NoiseModel& local_error, OwnedDepth<float>& depth) {
  std::mt19937 random(1);
  std::normal_distribution<double> error(0.0, 1.0);
  for (int v = 0; v < depth.height; v += 8) {
    for (int u = 0; u < depth.width; u += 8) {
      const double e = error(random);
      for (int i = 0; i < 64; ++i) {
        float& z = depth.at(u + i % 8, v + i / 8);
        const double down = -kUp.dot(testCamera().ray({u + i % 8, v + i / 8}).homogeneous());
        z -= static_cast<float>(e * local_error.sigma(static_cast<double>(z)) / down);
      }
    }
  }
}

/// The errors of blocks of 16 pixels, four tiles, vary by half of the local error of 6.6 mm, and
/// means of three of these are trusted to no less than 0.3 of it: of these, 1000 false alarms an
/// image are 1.8, 3.5 mm, and a billionth of one 7.5, 15 mm.
TEST(LowObstacles, MoreFalseAlarmsBuyLowerObstacles) {
  const auto shareOf = [](double height, double rate) {
    Parameters parameters;
    parameters.local_error = {0.003, 0.002};
    parameters.false_alarm_rate = rate;
    auto depth = floorWith([=](double x, double y) { return box(x, y, height); });
    addTileErrors(parameters.local_error, depth);
    return sharesWhere(detectIn(depth, parameters), depth, kOnBox).obstacle;
  };
  EXPECT_LT(shareOf(0.008, 1e-9), 0.02);
  EXPECT_GT(shareOf(0.008, 1000.0), 0.3);
  EXPECT_GT(shareOf(0.040, 1e-9), 0.9);
}

/// What a camera sees of a box 30 cm wide: its face, its top, and the floor about it.
OwnedDepth<float> boxFromOutside(double height, double nearest, double farthest) {
  const CameraModel camera = testCamera();
  OwnedDepth<float> depth = planeDepth(camera, kUp, kCameraHeight);
  const Eigen::Vector3d ahead = (Eigen::Vector3d::UnitZ() - kUp.z() * kUp).normalized();
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.ray({u, v}).homogeneous();
      const double face = nearest / ahead.dot(ray), top = (kCameraHeight - height) / -kUp.dot(ray);
      const double face_height = kCameraHeight + face * kUp.dot(ray);
      const auto put = [&](double z) {
        if (std::abs(z * ray.x()) < 0.15) depth.at(u, v) = static_cast<float>(z);
      };
      if (isIn(face_height, 0.0, height)) put(face);
      if (isIn(top * ahead.dot(ray), nearest, farthest)) put(top);
    }
  }
  return depth;
}

/// The face of a box of 5 cm reaches down to the floor, where it is within the plane's noise.
TEST(LowObstacles, AFaceBelongsToTheObstacleDownToTheFloor) {
  const OwnedDepth<float> with = boxFromOutside(0.05, 1.8, 1.9);
  const OwnedDepth<float> without = planeDepth(testCamera(), kUp, kCameraHeight);
  const Detection detection = detectIn(with);
  ASSERT_TRUE(detection.found()) << detection.reason;
  int on_box = 0, obstacle = 0, wrong = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const auto at = static_cast<std::size_t>(v * 640 + u);
      const float z = with.pixels[at];
      if (z < 0.5F || z > 4.0F) continue;
      if (z != without.pixels[at]) {
        ++on_box;
        obstacle += detection.label(u, v) == Label::kObstacle;
      } else {
        wrong += detection.label(u, v) == Label::kObstacle;
      }
    }
  }
  EXPECT_GT(on_box, 1500);
  EXPECT_GT(obstacle, 0.95 * on_box);
  EXPECT_LE(wrong, 8);  // where a pixel shows both
}

/// Pixels of a floor 2 m away that read 4 m: 10 by 10 are a speck, 60 by 10 a gap.
TEST(LowObstacles, ASpeckIsNoDropOff) {
  OwnedDepth<float> depth = planeDepth(testCamera(), kUp, kCameraHeight);
  for (int v = 200; v < 210; ++v) {
    for (int u = 100; u < 110; ++u) depth.at(u, v) = 3.9F;
    for (int u = 300; u < 360; ++u) depth.at(u, v) = 3.9F;
  }
  const Detection detection = detectIn(depth);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_EQ(detection.label(105, 205), Label::kUnknown);
  EXPECT_EQ(detection.label(330, 205), Label::kDropOff);
}

/// A hollow of the sensor's error, 14 mm deep, and a plate of 16 mm in it: within 0.75 sigma(z) of
/// the plane, but not of the ground nearby.
TEST(LowObstacles, WhatStandsInAHollowIsSeen) {
  const auto hollow = [](double x, double y) {
    return -0.014 * std::exp(-(x * x + (y - 1.5) * (y - 1.5)) / 0.18);
  };
  const auto on_plate = [](double x, double y) {
    return isIn(x, -0.1, 0.1) && isIn(y, 1.42, 1.58);
  };
  const auto depth =
      floorWith([&](double x, double y) { return hollow(x, y) + (on_plate(x, y) ? 0.016 : 0.0); });
  const Detection detection = detectIn(depth);
  ASSERT_TRUE(detection.found()) << detection.reason;
  EXPECT_GT(sharesWhere(detection, depth, on_plate).obstacle, 0.9);
  const auto apart = [](double x, double y) {
    return !(isIn(x, -0.15, 0.15) && isIn(y, 1.32, 1.68)) && isIn(x, -0.4, 0.4) &&
           isIn(y, 0.8, 2.0);
  };
  EXPECT_GT(sharesWhere(detection, depth, apart).ground, 0.99);
}

/// Where another surface below the ground was found, on one half of a box.
TEST(LowObstacles, ADropOffStaysOne) {
  const auto depth = floorWith([](double x, double y) { return box(x, y, 0.02); });
  RayTable rays;
  rays.build(testCamera());
  const DepthView view = depth.view();
  const ImageInput input{view, rays, {1.0F, 0.5F, 4.0F}};
  const Eigen::Vector3f up = kUp.cast<float>();
  const auto height = static_cast<float>(kCameraHeight);
  const LabelRule rule{{up.x(), up.y(), up.z()}, height, 0.01F, 0.007F, 0.0025F, 0.0018F};
  std::vector<std::uint8_t> kinds(80 * 60, kNearGround), labels(depth.pixels.size());
  BlockHeights blocks;
  runLabelKernel(input, rule, kinds.data(), labels.data(), &blocks);
  constexpr auto kDropOff = static_cast<std::uint8_t>(Label::kDropOff);
  for (int v = 0; v < 480; ++v) {
    std::fill_n(labels.begin() + v * 640 + 320, 320, kDropOff);
  }
  LowObstacles obstacles;
  obstacles.look(input, rule, blocks, {0.005, 0.08, 0.2, {0.0005, 0.0012}}, kinds);
  obstacles.mark(labels);
  int marked = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const std::uint8_t label = labels[static_cast<std::size_t>(v * 640 + u)];
      marked += label == static_cast<std::uint8_t>(Label::kObstacle);
      if (u >= 320) {
        ASSERT_EQ(label, kDropOff) << u << ", " << v;
      }
    }
  }
  EXPECT_GT(marked, 500);
}

TEST(LowObstacles, EvidenceFollowsFromTheRateOfFalseAlarms) {
  // One-sided tails of the normal distribution: 0.00135 beyond 3, 3.167e-5 beyond 4.
  EXPECT_NEAR(ObstacleEvidence::deviations(1000, 1.35), 3.0, 0.001);
  EXPECT_NEAR(ObstacleEvidence::deviations(100000, 3.1671), 4.0, 0.001);
  EXPECT_NEAR(ObstacleEvidence::deviations(10, 1000.0), 0.0, 1e-6);
}

/// Heights of all blocks by a function of their column and row.
BlockHeights blocksOf(int columns, int rows, const std::function<double(int, int)>& height) {
  BlockHeights blocks;
  blocks.columns = columns;
  blocks.rows = rows;
  blocks.count.assign(blocks.size(), 16.0F);
  blocks.off.assign(blocks.size(), 0);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      blocks.sum.push_back(16.0F * static_cast<float>(height(x, y)));
    }
  }
  return blocks;
}

/// Fits the ground where everything is near it.
/// @param min_window [m]
LocalGround groundOf(const BlockHeights& blocks, double min_window) {
  RayTable rays;
  rays.build(testCamera());
  const Eigen::Vector3f up = kUp.cast<float>();
  const LabelRule plane{{up.x(), up.y(), up.z()}, 0.7F, 0.01F, 0.007F};
  const std::vector<std::uint8_t> everywhere(80 * 60, kNearGround);
  LocalGround ground;
  ground.fit(blocks, everywhere, rays, plane, {0.0005, 0.0012}, min_window);
  return ground;
}

TEST(LocalGround, FollowsASlopeAndLeavesOutWhatStandsOnIt) {
  const auto slope = [](int x, int y) { return 2e-5 * (x - 80) - 3e-5 * (y - 60); };
  const auto isOn = [](int x, int y) { return isIn(x, 70, 76) && isIn(y, 100, 106); };
  const BlockHeights blocks =
      blocksOf(160, 120, [&](int x, int y) { return slope(x, y) + (isOn(x, y) ? 0.01 : 0.0); });
  const LocalGround ground = groundOf(blocks, 0.01);
  for (const GroundLevel& level : ground.levels()) {
    SCOPED_TRACE(level.block);
    const double side = level.block;
    for (int y = 4; y + 4 < level.rows; ++y) {
      for (int x = 4; x + 4 < level.columns; ++x) {
        const std::size_t at = level.at(x, y);
        if (level.depth[at] <= 0.0F) continue;
        const double truth =
            2e-5 * ((x + 0.5) * side / 4.0 - 80.5) - 3e-5 * ((y + 0.5) * side / 4.0 - 60.5);
        EXPECT_NEAR(static_cast<double>(level.ground[at]), truth, 6e-4) << x << ", " << y;
        EXPECT_GT(level.support[at], 0.25F);
      }
    }
    EXPECT_NEAR(static_cast<double>(level.groundAt(320, 300)), slope(80, 75), 1e-4);
  }
  // Not even the smallest window is filled by it: its height is not taken for ground.
  const GroundLevel& finest = ground.levels()[0];
  EXPECT_NEAR(static_cast<double>(finest.ground[finest.at(73, 103)]), slope(73, 103), 2e-4);
}

TEST(LocalGround, RowsThatAreTooNearForASmallWindowAreLeftToLargerOnes) {
  const LocalGround ground = groundOf(blocksOf(160, 120, [](int, int) { return 0.0; }), 0.12);
  // 7 blocks of 4 px are 12 cm wide at 0.12 m * 525 / 28 = 2.25 m.
  const GroundLevel& finest = ground.levels()[0];
  EXPECT_NEAR(finest.min_depth, 2.25F, 1e-4F);
  ASSERT_GT(finest.end_row, finest.first_row);
  EXPECT_GE(finest.depth[finest.at(80, finest.end_row - 1)], 2.25F);
  EXPECT_LT(finest.depth[finest.at(80, finest.end_row)], 2.25F);
}

}  // namespace
}  // namespace dominant_plane_detection
