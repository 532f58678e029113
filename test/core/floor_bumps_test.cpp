#include "core/floor_bumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/floor_ridges.h"

namespace dominant_plane_detection {
namespace {

const NoiseModel kError{0.002, 0.001};
constexpr float kDepth = 2.0F;    // [m]
constexpr float kSigma = 0.006F;  // [m] the local error there

/// A floor of blocks of 4 pixels, all read and all ground, at one depth.
GroundLevel flatLevel() {
  GroundLevel level;
  level.block = 4;
  level.columns = 160;
  level.rows = 120;
  level.end_row = level.rows;
  level.count.assign(level.size(), 16.0F);
  level.mean.assign(level.size(), 0.0F);
  level.ground.assign(level.size(), 0.0F);
  level.support.assign(level.size(), 1.0F);
  level.depth.assign(level.size(), kDepth);
  level.can_support.assign(level.size(), 1.0F);
  return level;
}

void addErrors(float sigma, unsigned seed, GroundLevel& level) {
  std::mt19937 random(seed);
  std::normal_distribution<float> error(0.0F, sigma);
  for (float& mean : level.mean) mean += error(random);
}

FloorBumps bumpsOf(const GroundLevel& level) {
  FloorBumps bumps;
  bumps.find(level, std::vector<float>(level.size(), 1.0F), kError);
  return bumps;
}

TEST(FloorBumps, AreMeansOfThreeBlocksOverTheGroundAboutThem) {
  GroundLevel level = flatLevel();
  const std::size_t at = level.at(50, 60);
  level.mean[at - 1] = 0.011F;
  level.mean[at] = 0.014F;
  level.mean[at + 1] = 0.008F;
  level.ground[at - 1] = level.ground[at] = level.ground[at + 1] = 0.002F;
  const FloorBumps bumps = bumpsOf(level);
  EXPECT_NEAR(bumps.over[at], 0.009F, 1e-6F);
  EXPECT_NEAR(bumps.over[at + 1], 0.006F, 1e-6F);
  EXPECT_NEAR(bumps.over[at - 2], 0.003F, 1e-6F);
  EXPECT_EQ(bumps.over[at + 3], 0.0F);
}

TEST(FloorBumps, NeedTwoBlocksOfThreeThatAreReadAndClear) {
  GroundLevel level = flatLevel();
  level.mean.assign(level.size(), 0.012F);
  const std::size_t at = level.at(50, 60);
  level.count[at + 1] = 7.0F;  // less than half of its pixels
  std::vector<float> clear(level.size(), 1.0F);
  clear[at + 3] = 0.0F;
  FloorBumps bumps;
  bumps.find(level, clear, kError);
  EXPECT_NEAR(bumps.over[at], 0.012F, 1e-6F);
  EXPECT_EQ(bumps.is_floor[at], 0.0F);
  EXPECT_EQ(bumps.over[at + 2], 0.0F);  // one of three
  EXPECT_EQ(bumps.is_floor[at - 1], 1.0F);
}

/// Means of three independent errors vary by 1 / sqrt(3) of them.
TEST(FloorBumps, TheScaleIsWhatThreeBlocksAverageOutOnTheFloorItself) {
  GroundLevel level = flatLevel();
  addErrors(kSigma, 1, level);
  EXPECT_NEAR(bumpsOf(level).scale, 1.0 / std::sqrt(3.0), 0.02);
  GroundLevel smooth = flatLevel();
  for (int y = 0; y < smooth.rows; ++y) {
    for (int x = 0; x < smooth.columns; ++x) {
      smooth.mean[smooth.at(x, y)] =
          kSigma * std::sqrt(2.0F) * std::sin(0.1F * static_cast<float>(x));
    }
  }
  EXPECT_NEAR(bumpsOf(smooth).scale, 1.0, 0.02);
}

/// Larger errors than the profile's are cut off where only what it explains is believed: they are
/// measured again, with what they are themselves.
TEST(FloorBumps, ASensorThatErrsMoreThanItsProfileSaysIsBelieved) {
  for (const float times : {1.5F, 2.0F}) {
    GroundLevel level = flatLevel();
    addErrors(times * std::sqrt(3.0F) * kSigma, 4, level);
    EXPECT_NEAR(bumpsOf(level).scale, times, 0.1F * times);
  }
}

TEST(FloorBumps, WhatStandsOnTheFloorDoesNotCountAsItsError) {
  GroundLevel level = flatLevel();
  addErrors(kSigma, 2, level);
  for (int y = 20; y < 50; ++y) {
    for (int x = 20; x < 60; ++x) level.mean[level.at(x, y)] += 0.1F;
  }
  EXPECT_NEAR(bumpsOf(level).scale, 1.0 / std::sqrt(3.0), 0.02);
}

TEST(FloorBumps, AFloorWithoutErrorsOrTooSmallIsNotBelieved) {
  EXPECT_EQ(bumpsOf(flatLevel()).scale, kMinErrorScale);
  GroundLevel level = flatLevel();
  level.end_row = 2;  // 80 blocks are looked at
  EXPECT_EQ(bumpsOf(level).scale, 1.0F);
}

FloorRidges ridgesOf(const GroundLevel& level) {
  FloorRidges ridges;
  ridges.find(level, bumpsOf(level), kError);
  return ridges;
}

/// Three rows high: its middle is 2 rows from the floor to both sides, the other two are 1 and 3.
TEST(FloorRidges, AreHigherThanTheFloorCloseBeforeAndCloseBehind) {
  GroundLevel level = flatLevel();
  for (int x = 40; x < 60; ++x) {
    level.mean[level.at(x, 30)] = level.mean[level.at(x, 31)] = 0.02F;
    level.mean[level.at(x, 70)] = level.mean[level.at(x, 71)] = level.mean[level.at(x, 72)] = 0.02F;
  }
  const FloorRidges ridges = ridgesOf(level);
  EXPECT_NEAR(ridges.height(level.at(50, 30)), 0.02F, 1e-6F);
  EXPECT_NEAR(ridges.height(level.at(50, 31)), 0.02F, 1e-6F);
  EXPECT_EQ(ridges.height(level.at(50, 32)), 0.0F);
  EXPECT_EQ(ridges.height(level.at(50, 71)), 0.0F);  // too long to be seen from two rows away
}

TEST(FloorRidges, AStepOrASlopeIsNone) {
  GroundLevel level = flatLevel();
  for (int y = 0; y < level.rows; ++y) {
    for (int x = 0; x < level.columns; ++x) {
      level.mean[level.at(x, y)] = x < 80 ? 0.001F * static_cast<float>(y) : y < 60 ? 0.02F : 0.0F;
    }
  }
  const FloorRidges ridges = ridgesOf(level);
  for (int y = 0; y < level.rows; ++y) {
    EXPECT_NEAR(ridges.height(level.at(40, y)), 0.0F, 1e-6F) << y;
    EXPECT_NEAR(ridges.height(level.at(120, y)), 0.0F, 1e-6F) << y;
  }
}

/// Differences that are multiples of each other have no covariance to speak of.
TEST(FloorRidges, SlopesHaveNoErrors) {
  for (const float slope : {0.00033F, 0.00043F, 0.00053F, 0.001F, 0.0015F}) {
    GroundLevel level = flatLevel();
    for (std::size_t i = 0; i < level.size(); ++i) {
      level.mean[i] = slope * static_cast<float>(i / static_cast<std::size_t>(level.columns));
    }
    EXPECT_EQ(ridgesOf(level).scale(), kMinErrorScale) << slope;
  }
}

TEST(FloorRidges, AreNotKnownWhereAnyOfTheBlocksIsNoFloor) {
  GroundLevel level = flatLevel();
  for (int x = 40; x < 60; ++x) level.mean[level.at(x, 30)] = 0.02F;
  level.can_support[level.at(49, 32)] = 0.0F;
  const FloorRidges ridges = ridgesOf(level);
  EXPECT_EQ(ridges.height(level.at(50, 30)), 0.0F);
  EXPECT_NEAR(ridges.height(level.at(52, 30)), 0.02F, 1e-6F);
}

/// Differences of independent errors e have the covariance (2 1; 1 2) e^2: a pair that exceeds t is
/// at least t / (1.22 e) deviations away.
TEST(FloorRidges, TheScaleFollowsFromTheCovarianceOfTheFloorsErrors) {
  GroundLevel level = flatLevel();
  addErrors(kSigma, 3, level);
  EXPECT_NEAR(ridgesOf(level).scale(), std::sqrt(1.5 / 3.0), 0.04);
}

/// Errors that hang together from row to row make smaller differences, and so lower ridges count.
/// Either way about as many blocks exceed it as of normal errors: at 3 deviations, 2 times 0.00135
/// of them at most, as there are two pairs.
TEST(FloorRidges, AsManyErrorsExceedItAsOfNormalOnes) {
  for (const bool smooth : {false, true}) {
    std::size_t blocks = 0, high = 0;
    for (unsigned seed = 0; seed < 20; ++seed) {
      GroundLevel level = flatLevel();
      addErrors(kSigma, seed, level);
      if (smooth) {  // means of four rows, as large as before
        for (int y = 0; y + 3 < level.rows; ++y) {
          for (int x = 0; x < level.columns; ++x) {
            float sum = 0.0F;
            for (int k = 0; k < 4; ++k) sum += level.mean[level.at(x, y + k)];
            level.mean[level.at(x, y)] = 0.5F * sum;
          }
        }
      }
      const FloorRidges ridges = ridgesOf(level);
      for (int y = 10; y < 100; ++y) {
        for (int x = 10; x < 150; ++x) {
          high += ridges.height(level.at(x, y)) > 3.0F * kSigma * ridges.scale();
          ++blocks;
        }
      }
    }
    const double share = static_cast<double>(high) / static_cast<double>(blocks);
    EXPECT_LT(share, 0.0027) << smooth;
    EXPECT_GT(share, 0.0002) << smooth;
  }
}

}  // namespace
}  // namespace dominant_plane_detection
