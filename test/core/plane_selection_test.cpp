#include "core/plane_selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace dominant_plane_detection {
namespace {

const PlaneLimits kLimits{{0.0, -1.0, 0.0}, 1.0, 0.5, 2.0, 100};

/// A plane whose normal is turned from up.
HessePlane plane(double tilt, double height) {
  return {{0.0, std::cos(tilt), std::sin(tilt)}, height};
}

std::string reason(const PlaneSelection& selection, std::size_t seeds = 3) {
  std::array<char, 256> sentence{};
  selection.explain(seeds, sentence);
  return sentence.data();
}

TEST(PlaneSelection, TheLargestThatCanBeGroundWins) {
  PlaneSelection selection(kLimits);
  EXPECT_FALSE(selection.found());
  EXPECT_EQ(selection.toBeat(), 100U);
  EXPECT_EQ(selection.consider(plane(0.1, 1.0), 300), State::kFound);
  EXPECT_EQ(selection.consider(plane(0.2, 1.1), 299), State::kFound);
  EXPECT_EQ(selection.consider(plane(0.2, 1.1), 300), State::kFound);
  EXPECT_EQ(selection.consider(plane(1.2, 1.0), 500), State::kTooTilted);
  EXPECT_TRUE(selection.found());
  EXPECT_EQ(selection.plane().distance, 1.0);
  EXPECT_EQ(selection.points(), 300U);
  EXPECT_EQ(selection.toBeat(), 300U);
  EXPECT_EQ(selection.consider(plane(0.3, 1.2), 301), State::kFound);
  EXPECT_EQ(selection.plane().distance, 1.2);
}

TEST(PlaneSelection, OfLevelsOfLikeSizeTheNearestWins) {
  PlaneSelection selection(kLimits);
  selection.consider(plane(0.0, 1.0), 400, 2.0);
  EXPECT_TRUE(selection.tookLast());
  selection.consider(plane(0.0, 1.1), 330, 0.5);
  EXPECT_TRUE(selection.tookLast());
  EXPECT_EQ(selection.plane().distance, 1.1);
  EXPECT_EQ(selection.points(), 330U);
  selection.consider(plane(0.0, 1.2), 400, 0.6);  // farther
  EXPECT_FALSE(selection.tookLast());
  selection.consider(plane(0.0, 1.2), 260, 0.1);  // too small
  EXPECT_FALSE(selection.tookLast());
  selection.consider(plane(0.0, 1.3), 350);  // no level of these: larger
  EXPECT_TRUE(selection.tookLast());
  selection.consider(plane(0.0, 1.4), 340, 0.1);
  EXPECT_FALSE(selection.tookLast());
  selection.consider(plane(0.0, 3.0), 350, 0.1);
  EXPECT_FALSE(selection.tookLast());
  EXPECT_EQ(selection.plane().distance, 1.3);
}

TEST(PlaneSelection, EachLimitIsOne) {
  PlaneSelection selection(kLimits);
  EXPECT_EQ(selection.consider(plane(0.0, 1.0), 99), State::kTooSmall);
  EXPECT_EQ(selection.consider(plane(0.0, 1.0), 100), State::kFound);
  EXPECT_EQ(selection.consider(plane(0.999, 1.0), 100), State::kFound);
  EXPECT_EQ(selection.consider(plane(1.001, 1.0), 100), State::kTooTilted);
  EXPECT_EQ(selection.consider(plane(-1.001, 1.0), 100), State::kTooTilted);
  EXPECT_EQ(selection.consider(plane(0.0, 0.499), 100), State::kOutOfHeightRange);
  EXPECT_EQ(selection.consider(plane(0.0, 0.501), 100), State::kFound);
  EXPECT_EQ(selection.consider(plane(0.0, 1.999), 100), State::kFound);
  EXPECT_EQ(selection.consider(plane(0.0, 2.001), 100), State::kOutOfHeightRange);
  PlaneLimits level = kLimits;
  level.max_tilt = 0.0;
  level.min_height = level.max_height = 1.0;
  EXPECT_EQ(PlaneSelection(level).consider(plane(0.0, 1.0), 100), State::kFound);
  // Even without a limit a plane has points.
  PlaneLimits none = kLimits;
  none.min_points = 0;
  EXPECT_EQ(PlaneSelection(none).consider(plane(0.0, 1.0), 0), State::kTooSmall);
  EXPECT_EQ(PlaneSelection(none).minPoints(), 1U);
}

TEST(PlaneSelection, SeedsAreClearlyTooTiltedTwentyDegreesBeyond) {
  const PlaneSelection selection(kLimits);
  EXPECT_FALSE(selection.clearlyTooTilted(plane(1.0, 1.0)));
  EXPECT_FALSE(selection.clearlyTooTilted(plane(1.34, 1.0)));
  EXPECT_TRUE(selection.clearlyTooTilted(plane(1.36, 1.0)));
}

/// The largest plane that was refused is why there is none.
TEST(PlaneSelection, TheReasonIsThatOfTheLargest) {
  PlaneSelection selection(kLimits);
  EXPECT_EQ(selection.refusal(), State::kNoRegion);
  EXPECT_EQ(reason(selection, 7), "None of 7 seeds lies on a plane.");
  selection.consider(plane(0.0, 1.0), 50);
  EXPECT_EQ(selection.refusal(), State::kTooSmall);
  EXPECT_EQ(reason(selection),
            "The largest plane holds 50 pixels, fewer than the required 100 (min_share, "
            "min_patch).");
  selection.consider(plane(1.25, 1.0), 200);
  EXPECT_EQ(selection.refusal(), State::kTooTilted);
  EXPECT_EQ(reason(selection),
            "The largest plane is tilted by 1.250 rad from the expected up direction, more than "
            "max_tilt = 1.000 rad.");
  selection.consider(plane(0.0, 3.0), 150);
  EXPECT_EQ(selection.refusal(), State::kTooTilted);
  selection.consider(plane(0.0, 3.0), 200);  // as large: the first stays
  EXPECT_EQ(selection.refusal(), State::kTooTilted);
  selection.consider(plane(0.0, 3.0), 250);
  EXPECT_EQ(selection.refusal(), State::kOutOfHeightRange);
  EXPECT_EQ(reason(selection),
            "The camera is 3.000 m over the largest plane, expected 0.500 to 2.000 m.");
  selection.consider(plane(1.5, 1.0), 10);
  EXPECT_EQ(selection.refusal(), State::kOutOfHeightRange);
}

/// Limits under which the lowest plane wins that has 200 pixels.
PlaneLimits lowestLimits() {
  PlaneLimits limits = kLimits;
  limits.lowest_from = 200;
  return limits;
}

TEST(PlaneSelection, TheLowestOfThoseThatAreLargeEnoughWins) {
  PlaneSelection selection(lowestLimits());
  EXPECT_TRUE(selection.isOpen(1));
  selection.consider(plane(0.0, 1.9), 199);  // too small to be more than the largest
  EXPECT_EQ(selection.toBeat(), 199U);
  EXPECT_FALSE(selection.isOpen(199));
  EXPECT_TRUE(selection.isOpen(200));
  selection.consider(plane(0.0, 0.8), 5000);
  EXPECT_TRUE(selection.tookLast());
  EXPECT_EQ(selection.toBeat(), 200U);
  EXPECT_TRUE(selection.isOpen(200));
  EXPECT_FALSE(selection.isOpen(199));
  selection.consider(plane(0.0, 1.5), 200);
  EXPECT_TRUE(selection.tookLast());
  selection.consider(plane(0.0, 0.8), 6000);
  EXPECT_FALSE(selection.tookLast());
  selection.consider(plane(0.0, 1.9), 199);
  EXPECT_FALSE(selection.tookLast());
  EXPECT_EQ(selection.plane().distance, 1.5);
}

TEST(PlaneSelection, PiecesOfOneFloorHaveAlmostOneHeight) {
  PlaneSelection selection(lowestLimits());
  selection.consider(plane(0.0, 1.50), 800);
  selection.consider(plane(0.0, 1.59), 300);
  EXPECT_FALSE(selection.tookLast());
  selection.consider(plane(0.0, 1.41), 900);
  EXPECT_TRUE(selection.tookLast());
  selection.consider(plane(0.0, 1.52), 300);
  EXPECT_TRUE(selection.tookLast());
}

/// Two degrees that a sensor's error bends a floor by, or a table.
TEST(PlaneSelection, HeightsAreComparedWherePlanesAre) {
  const double bend = 0.035;  // [rad] 11 cm three metres ahead
  const HessePlane near = plane(0.0, 1.0);
  const Eigen::Vector3d ahead(0.0, 1.0, 3.0);
  PlaneSelection bent(lowestLimits());
  bent.consider(near, 900);
  const Eigen::Vector3d normal = plane(bend, 1.0).normal;
  bent.consider({normal, normal.dot(ahead)}, 400, INFINITY, ahead);
  EXPECT_GT(normal.dot(ahead), 1.1);
  EXPECT_FALSE(bent.tookLast());
  // A floor 20 cm lower there.
  const Eigen::Vector3d below(0.0, 1.2, 3.0);
  bent.consider({near.normal, 1.2}, 400, INFINITY, below);
  EXPECT_TRUE(bent.tookLast());
}

TEST(PlaneSelection, TheExpectedHeightComesBeforeSizeAndDepth) {
  for (const bool lowest : {false, true}) {
    PlaneLimits limits = lowest ? lowestLimits() : kLimits;
    limits.expected_height = Prior::ExpectedHeight{1.0, 0.1};
    PlaneSelection selection(limits);
    selection.consider(plane(0.0, 0.6), 5000);
    EXPECT_TRUE(selection.tookLast());
    EXPECT_EQ(selection.toBeat(), 100U);  // any could be at that height
    EXPECT_TRUE(selection.isOpen(100));
    EXPECT_FALSE(selection.isOpen(99));
    selection.consider(plane(0.0, 0.91), 100);
    EXPECT_TRUE(selection.tookLast());
    selection.consider(plane(0.0, 1.11), 9000);
    EXPECT_FALSE(selection.tookLast());
    selection.consider(plane(0.0, 1.09), 150);
    EXPECT_TRUE(selection.tookLast());
    selection.consider(plane(0.0, 1.0), 140);
    EXPECT_FALSE(selection.tookLast());
    EXPECT_EQ(selection.toBeat(), 150U);
    EXPECT_FALSE(selection.isOpen(150));
  }
}

TEST(PlaneSelection, TheReasonSaysWhichLimitItWas) {
  PlaneLimits limits = lowestLimits();
  limits.max_tilt = 0.3;
  PlaneSelection selection(limits);
  selection.consider(plane(0.5, 1.0), 300);
  EXPECT_EQ(reason(selection),
            "The largest plane is tilted by 0.500 rad from the expected up direction, more than a "
            "level one may be (prefer), 0.300 rad.");
}

}  // namespace
}  // namespace dominant_plane_detection
