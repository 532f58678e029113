#include "navigation/local_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "navigation/ground_sight.h"
#include "navigation/planar_pose.h"
#include "navigation/told_height.h"

namespace dominant_plane_detection {
namespace {

constexpr double kCell = 0.05, kSize = 6.0;

class Map {
 public:
  explicit Map(double memory = 10.0) : map_(kCell, kSize, memory) {}

  /// Adds an image a thirtieth of a second after the last.
  void add(GroundSight& sight, const Eigen::Isometry2d& pose = Eigen::Isometry2d::Identity()) {
    time_ += 1.0 / 30.0;
    map_.add(time_, sight.depth(), sight.rays(), sight.detection(), limits, pose);
  }
  void wait(double seconds) { map_.age(time_ += seconds); }
  LocalMap::State at(const Eigen::Vector2d& place) const {
    const Eigen::Vector2d cell = (place - map_.grid().origin()) / kCell;
    return map_.state(static_cast<int>(std::floor(cell.x())),
                      static_cast<int>(std::floor(cell.y())));
  }
  LocalMap& map() { return map_; }

  MapLimits limits;

 private:
  LocalMap map_;
  double time_ = 100.0;
};

Eigen::Vector2d polar(double direction, double range) {
  return {range * std::cos(direction), range * std::sin(direction)};
}

/// An image without readings.
GroundSight blindSight() {
  GroundSight sight(20.0 * kDegree, 0.0);
  sight.changeFloor([](const Eigen::Vector2d&, float& depth, std::uint8_t& label) {
    depth = 0.0F;
    label = static_cast<std::uint8_t>(Label::kUnknown);
  });
  return sight;
}

/// A post with free floor before it, whatever the camera's pitch and roll and wherever it is.
TEST(LocalMap, WhatIsSeenIsFreeOrOccupiedAndTheRestIsUnknown) {
  for (const double memory : {0.0, 10.0}) {
    for (const double roll : {-10.0, 0.0, 10.0}) {
      for (const auto& place : {planarPose(0.0, 0.0, 0.0), planarPose(31.27, -8.4, 2.0)}) {
        const double direction = 8.0 * kDegree;
        GroundSight sight(20.0 * kDegree, roll * kDegree);
        sight.addPost(direction, 1.52, 0.0, 0.5);
        Map map(memory);
        map.add(sight, place);
        EXPECT_EQ(map.at(place * polar(direction, 1.52)), LocalMap::kOccupied);
        for (const double range : {1.0, 1.2, 1.4}) {
          EXPECT_EQ(map.at(place * polar(direction, range)), LocalMap::kFree) << range;
        }
        for (const double range : {1.0, 1.5, 2.0, 2.3}) {
          EXPECT_EQ(map.at(place * polar(-direction, range)), LocalMap::kFree) << range;
        }
        // Behind the post, below and behind the camera, and beside what it sees.
        EXPECT_EQ(map.at(place * polar(direction, 1.8)), LocalMap::kUnknown);
        EXPECT_EQ(map.at(place * polar(0.0, 0.3)), LocalMap::kUnknown);
        EXPECT_EQ(map.at(place * polar(M_PI, 1.0)), LocalMap::kUnknown);
        EXPECT_EQ(map.at(place * polar(0.9, 1.5)), LocalMap::kUnknown);
      }
    }
  }
}

/// Far from the middle of the image, where the distortion is 5 cm on the floor.
TEST(LocalMap, ALensMayBeDistorted) {
  CameraModel camera = testCamera();
  camera.distortion = DistortionModel::kPlumbBob;
  camera.coefficients = {-0.3, 0.05, 0.001, -0.001};
  GroundSight sight(20.0 * kDegree, 0.0, camera);
  const double direction = 0.5, wide = 1.5 * kDegree;
  sight.mark(direction, 0.5, Label::kDropOff);
  Map map;
  map.add(sight);
  for (const double range : {1.6, 1.7, 1.8, 1.9, 2.0}) {
    const double cell = 1.1 * kCell / range;  // [rad] no place of it is beyond the border
    EXPECT_EQ(map.at(polar(direction, range)), LocalMap::kOccupied) << range;
    EXPECT_EQ(map.at(polar(direction + wide + cell, range)), LocalMap::kFree) << range;
    EXPECT_EQ(map.at(polar(direction - wide - cell, range)), LocalMap::kFree) << range;
  }
}

TEST(LocalMap, WhatGoesAwayIsFreeAgain) {
  GroundSight free(20.0 * kDegree, 0.0), with_post(20.0 * kDegree, 0.0);
  with_post.addPost(0.0, 1.52, 0.0, 0.5);
  Map map;
  for (int i = 0; i < 60; ++i) map.add(with_post);
  ASSERT_EQ(map.at(polar(0.0, 1.52)), LocalMap::kOccupied);
  for (int i = 0; i < 5; ++i) map.add(free);
  EXPECT_EQ(map.at(polar(0.0, 1.52)), LocalMap::kOccupied);
  for (int i = 0; i < 6; ++i) map.add(free);
  EXPECT_EQ(map.at(polar(0.0, 1.52)), LocalMap::kFree);
  // And one image is enough for it to be back.
  map.add(with_post);
  EXPECT_EQ(map.at(polar(0.0, 1.52)), LocalMap::kOccupied);
}

/// The floor below it is seen and it is not: it is there until one looks through where it was.
TEST(LocalMap, FloorBelowATableDoesNotTakeItAway) {
  const Eigen::Vector2d place = polar(0.0, 1.72);
  GroundSight table(15.0 * kDegree, 0.0), below(38.0 * kDegree, 0.0), gone(15.0 * kDegree, 0.0);
  table.addPost(0.0, 1.72, 0.45, 0.55);
  Map map;
  for (int i = 0; i < 5; ++i) map.add(table);
  ASSERT_EQ(map.at(place), LocalMap::kOccupied);
  for (int i = 0; i < 60; ++i) map.add(below);
  EXPECT_EQ(map.at(polar(0.1, 1.72)), LocalMap::kFree);  // it is in view
  EXPECT_EQ(map.at(place), LocalMap::kOccupied);
  for (int i = 0; i < 12; ++i) map.add(gone);
  EXPECT_EQ(map.at(place), LocalMap::kFree);
}

/// Nor does something low below it, which comes and goes.
TEST(LocalMap, AShoeBelowATableDoesNotTakeItAway) {
  const Eigen::Vector2d place = polar(0.0, 1.72);
  GroundSight table(15.0 * kDegree, 0.0), shoe(38.0 * kDegree, 0.0), below(38.0 * kDegree, 0.0);
  table.addPost(0.0, 1.72, 0.45, 0.55);
  shoe.addPost(0.0, 1.72, 0.0, 0.08);
  Map map;
  for (int i = 0; i < 5; ++i) map.add(table);
  for (int i = 0; i < 5; ++i) map.add(shoe);
  for (int i = 0; i < 60; ++i) map.add(below);
  EXPECT_EQ(map.at(place), LocalMap::kOccupied);
}

/// What fades becomes unknown: nobody has looked whether it is free.
TEST(LocalMap, NothingFadesIntoWhatIsFree) {
  GroundSight floor(20.0 * kDegree, 0.0), with_post(20.0 * kDegree, 0.0);
  with_post.addPost(0.0, 1.52, 0.0, 0.5);
  Map map;
  for (int i = 0; i < 30; ++i) map.add(floor);
  map.add(with_post);
  for (double waited = 0.0; waited < 100.0; waited += 0.5) {
    EXPECT_NE(map.at(polar(0.0, 1.52)), LocalMap::kFree) << waited;
    map.wait(0.5);
  }
  EXPECT_EQ(map.at(polar(0.0, 1.52)), LocalMap::kUnknown);
  map.add(floor);
  EXPECT_EQ(map.at(polar(0.0, 1.52)), LocalMap::kFree);
}

/// A wrong reading above it makes a thing higher than it is: that the camera looks through there
/// does not take it away.
/// Also where the floor below it is seen all the time: it is seen to be free after that at the
/// earliest.
TEST(LocalMap, WhatIsForgottenIsUnknownFirst) {
  const Eigen::Vector2d place = polar(0.0, 1.72);
  GroundSight table(15.0 * kDegree, 0.0), below(38.0 * kDegree, 0.0);
  table.addPost(0.0, 1.72, 0.45, 0.55);
  Map map;
  map.add(table);
  for (int i = 0; i < 66; ++i) {
    map.wait(0.5);
    map.add(below);
    EXPECT_NE(map.at(place), LocalMap::kFree) << i;
  }
  map.wait(3.0);
  EXPECT_EQ(map.at(polar(0.1, 1.72)), LocalMap::kFree);
  EXPECT_EQ(map.at(place), LocalMap::kUnknown);
  map.add(below);
  EXPECT_EQ(map.at(place), LocalMap::kFree);
}

TEST(LocalMap, AThingHasToBeLookedThroughFromTopToBottom) {
  GroundSight too_high(15.0 * kDegree, 0.0), farther(15.0 * kDegree, 0.0);
  too_high.addPost(0.0, 1.52, 0.15, 0.9);
  farther.addPost(0.0, 3.02, 0.0, 2.0);
  farther.addPost(0.0, 1.58, 0.15, 0.5);
  Map map;
  for (int i = 0; i < 5; ++i) map.add(too_high);
  for (int i = 0; i < 30; ++i) map.add(farther);
  EXPECT_EQ(map.at(polar(0.0, 1.52)), LocalMap::kOccupied);
}

TEST(LocalMap, InfinityIsNoReading) {
  GroundSight with_post(20.0 * kDegree, 0.0), endless = blindSight();
  with_post.addPost(0.0, 1.52, 0.0, 0.5);
  endless.changeFloor(
      [](const Eigen::Vector2d&, float& depth, std::uint8_t&) { depth = INFINITY; });
  Map map;
  map.add(with_post);
  for (int i = 0; i < 10; ++i) map.add(endless);
  EXPECT_EQ(map.at(polar(0.0, 1.52)), LocalMap::kOccupied);
}

/// And it is not taken away by wrong readings of the places beside it.
TEST(LocalMap, WhatIsHiddenStays) {
  GroundSight far(20.0 * kDegree, 0.0), near(20.0 * kDegree, 0.0);
  far.addPost(0.0, 1.72, 0.0, 0.5);
  near.addPost(0.0, 1.12, 0.0, 0.5);
  Map map;
  for (int i = 0; i < 5; ++i) map.add(far);
  for (int i = 0; i < 30; ++i) map.add(near);
  EXPECT_EQ(map.at(polar(0.0, 1.12)), LocalMap::kOccupied);
  EXPECT_EQ(map.at(polar(0.0, 1.72)), LocalMap::kOccupied);
}

TEST(LocalMap, DropOffsAreOccupiedAndMissingGroundIsIfItIsToBe) {
  GroundSight sight(20.0 * kDegree, 0.0), floor(20.0 * kDegree, 0.0);
  sight.mark(0.2, 1.5, Label::kDropOff);
  sight.mark(-0.2, 1.5, Label::kMissingGround);
  Map map;
  map.add(sight);
  EXPECT_EQ(map.at(polar(0.2, 1.4)), LocalMap::kFree);
  EXPECT_EQ(map.at(polar(0.2, 1.7)), LocalMap::kOccupied);
  EXPECT_EQ(map.at(polar(-0.2, 1.7)), LocalMap::kUnknown);
  Map careful;
  careful.limits.missing_ground = true;
  careful.add(sight);
  EXPECT_EQ(careful.at(polar(-0.2, 1.7)), LocalMap::kOccupied);
  EXPECT_EQ(careful.at(polar(-0.2, 1.4)), LocalMap::kFree);
  for (int i = 0; i < 5; ++i) careful.add(floor);
  EXPECT_EQ(careful.at(polar(-0.2, 1.7)), LocalMap::kFree);
  EXPECT_EQ(careful.at(polar(0.2, 1.7)), LocalMap::kFree);
}

/// A cell with a hole in a quarter of it is not free.
TEST(LocalMap, WhatIsPartlyAHoleIsNotFree) {
  GroundSight sight(20.0 * kDegree, 0.0);
  sight.mark(std::atan2(0.15, 1.55), 1.5, Label::kDropOff);
  LocalMap coarse(0.2, 6.0, 10.0);
  coarse.add(1.0, sight.depth(), sight.rays(), sight.detection(), {},
             Eigen::Isometry2d::Identity());
  const auto at = [&](double x, double y) {
    const Eigen::Vector2d cell = (Eigen::Vector2d(x, y) - coarse.grid().origin()) / 0.2;
    return coarse.state(static_cast<int>(std::floor(cell.x())),
                        static_cast<int>(std::floor(cell.y())));
  };
  EXPECT_EQ(at(1.5, 0.1), LocalMap::kUnknown);
  EXPECT_EQ(at(1.5, -0.1), LocalMap::kFree);
}

/// Ground that is labelled as such from behind a reading is not there: the foot of a thing.
TEST(LocalMap, TheFootOfAThingIsNoGroundBehindIt) {
  GroundSight sight(20.0 * kDegree, 0.0);
  sight.addPost(0.0, 1.52, 0.08, 0.5);
  sight.addPost(0.0, 1.52, 0.0, 0.08, Label::kGround);  // beyond which the plane is 1.75 m away
  Map map;
  map.add(sight);
  EXPECT_EQ(map.at(polar(0.0, 1.4)), LocalMap::kFree);
  for (const double range : {1.62, 1.66, 1.7, 1.9}) {
    EXPECT_EQ(map.at(polar(0.0, range)), LocalMap::kUnknown) << range;
  }
}

TEST(LocalMap, GroundIsFreeAsFarAsThingsAreToldFromIt) {
  GroundSight sight(20.0 * kDegree, 0.0);
  sight.addPost(0.3, 2.52, 0.0, 0.5);
  Map map;
  map.limits.free_range = 2.0;  // [m] depth, at 20 degrees
  map.add(sight);
  EXPECT_EQ(map.at(polar(0.0, 1.85)), LocalMap::kFree);
  EXPECT_EQ(map.at(polar(0.0, 2.1)), LocalMap::kUnknown);
  EXPECT_EQ(map.at(polar(0.3, 2.52)), LocalMap::kOccupied);
  // 4.8 times the local error is the thing's height.
  EXPECT_NEAR(freeRange({0.0005, 0.0012}, 0.05), 2.87, 0.01);
  EXPECT_NEAR(freeRange({0.0, 0.0012}, 4.8 * 0.0012), 1.0, 1e-9);
  EXPECT_EQ(freeRange({0.02, 0.0012}, 0.05), 0.0);
  EXPECT_GT(freeRange({0.001, 0.0}, 0.05), 100.0);
}

TEST(LocalMap, WhatPassesUnderTheRobotOrAboveItIsNothing) {
  GroundSight sight(15.0 * kDegree, 0.0);
  sight.addPost(0.2, 1.72, 0.0, 0.08);
  sight.addPost(-0.2, 1.72, 0.55, 0.9);
  Map map;
  map.limits.clearance_height = 0.1;
  map.limits.max_obstacle_height = 0.5;
  map.add(sight);
  EXPECT_NE(map.at(polar(0.2, 1.72)), LocalMap::kOccupied);
  EXPECT_EQ(map.at(polar(-0.2, 1.72)), LocalMap::kFree);
  map.limits = MapLimits();
  map.add(sight);
  EXPECT_EQ(map.at(polar(0.2, 1.72)), LocalMap::kOccupied);
  EXPECT_EQ(map.at(polar(-0.2, 1.72)), LocalMap::kOccupied);
}

TEST(LocalMap, WhatIsNotSeenIsForgotten) {
  GroundSight sight(20.0 * kDegree, 0.0);
  sight.addPost(0.2, 1.52, 0.0, 0.5);
  Map map;
  for (int i = 0; i < 30; ++i) map.add(sight);
  map.wait(8.0);
  EXPECT_EQ(map.at(polar(0.2, 1.52)), LocalMap::kOccupied);
  EXPECT_EQ(map.at(polar(0.0, 1.5)), LocalMap::kFree);
  map.wait(25.0);
  EXPECT_EQ(map.at(polar(0.2, 1.52)), LocalMap::kUnknown);
  EXPECT_EQ(map.at(polar(0.0, 1.5)), LocalMap::kUnknown);
  // A recording that begins again begins with nothing.
  map.add(sight);
  map.wait(-5.0);
  EXPECT_EQ(map.at(polar(0.2, 1.52)), LocalMap::kUnknown);
}

/// It keeps what it knows where it was seen, as far as it reaches.
TEST(LocalMap, MovesWithTheCamera) {
  GroundSight sight(20.0 * kDegree, 0.0), nothing = blindSight();
  sight.addPost(0.0, 1.52, 0.0, 0.5);
  Map map;
  map.add(sight);
  for (double x = 0.0; x < 4.0; x += 0.13) {
    map.add(nothing, planarPose(x, -0.3 * x, 0.5));
    EXPECT_LE((map.map().grid().origin() + Eigen::Vector2d(0.5 * kSize, 0.5 * kSize) -
               Eigen::Vector2d(x, -0.3 * x))
                  .cwiseAbs()
                  .maxCoeff(),
              kCell);
    EXPECT_EQ(map.at(polar(0.0, 1.52)), LocalMap::kOccupied) << x;
  }
  // What left it is not what comes in on the other side, nor there when it comes back.
  map.add(nothing, planarPose(5.0, 0.0, 0.0));
  map.add(nothing, planarPose(0.0, 0.0, 0.0));
  EXPECT_EQ(map.at(polar(0.0, 1.52)), LocalMap::kUnknown);
  int known = 0;
  for (int y = 0; y < map.map().grid().cells(); ++y) {
    for (int x = 0; x < map.map().grid().cells(); ++x) {
      known += map.map().state(x, y) == LocalMap::kOccupied;
    }
  }
  EXPECT_EQ(known, 0);
}

/// With no memory each image is by itself.
TEST(LocalMap, WithoutMemoryEachImageIsByItself) {
  GroundSight sight(20.0 * kDegree, 0.0), nothing = blindSight();
  Map map(0.0);
  map.add(sight);
  EXPECT_EQ(map.at(polar(0.0, 1.5)), LocalMap::kFree);
  map.add(nothing);
  EXPECT_EQ(map.at(polar(0.0, 1.5)), LocalMap::kUnknown);
}

}  // namespace
}  // namespace dominant_plane_detection
