#include "core/seed_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "core/seed_order.h"

namespace dominant_plane_detection {
namespace {

const Eigen::Vector3d kUp(0.0, -1.0, 0.0);
const Eigen::Vector2d kSquare(500.0, 500.0);

std::set<std::size_t> firstGroup(int columns, int rows, const Eigen::Vector3d& up,
                                 const Eigen::Vector2d& focal_lengths = kSquare) {
  SeedOrder order;
  order.build(columns, rows, focal_lengths, up);
  const auto& cells = order.cells();
  return {cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(order.firstGroup())};
}

TEST(SeedOrder, TheLowerHalfFollowsUp) {
  using Cells = std::set<std::size_t>;
  EXPECT_EQ(firstGroup(3, 4, kUp), (Cells{6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(firstGroup(3, 4, -kUp), (Cells{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(firstGroup(4, 2, {1.0, 0.0, 0.0}), (Cells{0, 1, 4, 5}));
  EXPECT_EQ(firstGroup(4, 2, {-1.0, 0.0, 0.0}), (Cells{2, 3, 6, 7}));
  // A camera pitched by 80 degrees still has a lower half.
  EXPECT_EQ(firstGroup(3, 4, {0.0, -std::sin(0.175), -std::cos(0.175)}),
            (Cells{6, 7, 8, 9, 10, 11}));
  // Rolled by 45 degrees, the middle between top left and bottom right with the lower half.
  EXPECT_EQ(firstGroup(2, 2, {std::sqrt(0.5), -std::sqrt(0.5), 0.0}), (Cells{0, 2, 3}));
  EXPECT_EQ(firstGroup(3, 3, kUp), (Cells{3, 4, 5, 6, 7, 8}));
}

/// To the nearest of eight directions: the seeds do not depend on how well up is known.
TEST(SeedOrder, ALittleMoreRollChangesNothing) {
  const auto rolled = [](double degrees) {
    const double angle = degrees * M_PI / 180.0;
    return firstGroup(40, 30, {std::sin(angle), -std::cos(angle), 0.0});
  };
  EXPECT_EQ(rolled(22.0), rolled(0.0));
  EXPECT_EQ(rolled(-22.0), rolled(0.0));
  EXPECT_EQ(rolled(23.0), rolled(45.0));
  EXPECT_EQ(rolled(67.0), rolled(45.0));
  EXPECT_EQ(rolled(68.0), rolled(90.0));
  EXPECT_NE(rolled(22.0), rolled(23.0));
}

TEST(SeedOrder, OffsetsAreAnglesNotPixels) {
  // Up is at 45 degrees; with fx twice fy a column is half as far from the middle as a row.
  const Eigen::Vector3d up(std::sqrt(0.5), -std::sqrt(0.5), 0.0);
  const std::size_t right_of_bottom_middle = 4 * 5 + 4;  // two columns and two rows away
  EXPECT_EQ(firstGroup(5, 5, up, {1000.0, 500.0}).count(right_of_bottom_middle), 1U);
  EXPECT_EQ(firstGroup(5, 5, up, {250.0, 500.0}).count(right_of_bottom_middle), 0U);
}

TEST(SeedOrder, FiveDegreesFromTheAxisAreWhereItBegins) {
  for (const double degrees : {-6.0, -4.0, 4.0, 6.0}) {
    const double angle = degrees * M_PI / 180.0;
    SeedOrder order;
    order.build(40, 30, {500.0, 500.0}, {0.0, -std::sin(angle), -std::cos(angle)});
    EXPECT_EQ(order.firstGroup(), std::abs(degrees) < 5.0 ? 1200U : 600U) << degrees;
  }
}

TEST(SeedOrder, LookingStraightDownNoHalfIsLower) {
  EXPECT_EQ(firstGroup(4, 3, {0.0, 0.0, -1.0}).size(), 12U);
  EXPECT_EQ(firstGroup(4, 3, {0.0, -std::sin(0.07), std::cos(0.07)}).size(), 12U);
}

/// What is built is kept as long as nothing changes, and no longer.
TEST(SeedOrder, FollowsEachChange) {
  SeedOrder order;
  const Eigen::Vector3d slanting = Eigen::Vector3d(1.0, -1.0, 0.0).normalized();
  const auto expectFresh = [&](int columns, int rows, const Eigen::Vector2d& focal,
                               const Eigen::Vector3d& up) {
    SeedOrder fresh;
    fresh.build(columns, rows, focal, up);
    order.build(columns, rows, focal, up);
    EXPECT_EQ(order.cells(), fresh.cells());
    EXPECT_EQ(order.firstGroup(), fresh.firstGroup());
  };
  expectFresh(7, 5, {500.0, 500.0}, slanting);
  expectFresh(7, 5, {500.0, 100.0}, slanting);
  expectFresh(7, 5, {500.0, 100.0}, kUp);
  expectFresh(5, 7, {500.0, 100.0}, kUp);
  expectFresh(5, 4, {500.0, 100.0}, kUp);
  expectFresh(6, 4, {500.0, 100.0}, kUp);
  EXPECT_EQ(SeedOrder().cells().size() + SeedOrder().firstGroup(), 0U);
}

TEST(SeedOrder, HoldsEachCellOnce) {
  SeedOrder order;
  order.build(7, 5, kSquare, Eigen::Vector3d(0.3, -0.9, 0.1).normalized());
  std::vector<std::size_t> cells = order.cells();
  std::sort(cells.begin(), cells.end());
  std::vector<std::size_t> all(35);
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(cells, all);
  order.build(0, 0, kSquare, kUp);
  EXPECT_TRUE(order.cells().empty());
}

/// Ten points a cell; what a try does is up to the test.
class Cells : public RegionSource {
 public:
  explicit Cells(std::size_t count) : claimed(count, false) {}
  bool available(std::size_t cell) const override { return !claimed[cell]; }
  std::size_t availablePoints() const override {
    return 10U * static_cast<std::size_t>(std::count(claimed.begin(), claimed.end(), false));
  }
  bool tryRegion(std::size_t cell) override {
    tried.push_back(cell);
    return on_try(cell);
  }
  bool exhausted() const override { return tried.size() >= most_tries; }

  std::vector<bool> claimed;
  std::vector<std::size_t> tried;
  std::function<bool(std::size_t)> on_try = [](std::size_t) { return true; };
  std::size_t most_tries = 1000;
};

class SeedSearch : public testing::Test {
 protected:
  SeedSearch() { order_.build(4, 4, kSquare, kUp); }
  std::size_t search(std::size_t seeds) {
    RandomDraw draw;
    draw.restart(1);
    return searchSeeds(order_, seeds, selection_, draw, cells_);
  }
  void find(std::size_t points) {
    selection_.consider(HessePlane::through({0.0, 1.0, 2.0}, {0.0, 1.0, 0.0}), points);
  }

  SeedOrder order_;
  PlaneSelection selection_{{kUp, 1.0, 0.0, 10.0, 1}};
  Cells cells_{16};
};

TEST_F(SeedSearch, TriesTheLowerHalfFirstAndEachCellOnce) {
  EXPECT_EQ(search(100), 16U);
  ASSERT_EQ(cells_.tried.size(), 16U);
  EXPECT_TRUE(std::all_of(cells_.tried.begin(), cells_.tried.begin() + 8,
                          [](std::size_t cell) { return cell >= 8; }));
  EXPECT_EQ(std::set<std::size_t>(cells_.tried.begin(), cells_.tried.end()).size(), 16U);
}

TEST_F(SeedSearch, TheBudgetIsOneForTheWholeImage) {
  EXPECT_EQ(search(10), 10U);
  EXPECT_EQ(cells_.tried.size(), 10U);
}

TEST_F(SeedSearch, WhatIsNoSeedDoesNotCount) {
  cells_.claimed[9] = cells_.claimed[14] = true;
  cells_.on_try = [](std::size_t cell) { return cell % 2 == 0; };
  EXPECT_EQ(search(100), 7U);
  EXPECT_EQ(cells_.tried.size(), 14U);
  EXPECT_EQ(std::count(cells_.tried.begin(), cells_.tried.end(), 9), 0);
}

TEST_F(SeedSearch, EndsWhenNothingLargerCanBeLeft) {
  // The first region takes half of the cells, all in the lower half: the rest may be as large, not
  // larger.
  cells_.on_try = [this](std::size_t) {
    std::fill(cells_.claimed.begin() + 8, cells_.claimed.end(), true);
    find(80);
    return true;
  };
  EXPECT_EQ(search(100), 1U);
}

TEST_F(SeedSearch, GoesOnInTheUpperHalfWhileSomethingLargerMayBeLeft) {
  cells_.on_try = [this](std::size_t cell) {
    if (cell < 8) return true;
    std::fill(cells_.claimed.begin() + 8, cells_.claimed.end(), true);
    find(79);
    return true;
  };
  EXPECT_EQ(search(100), 9U);
}

TEST_F(SeedSearch, EndsWithTheWork) {
  cells_.most_tries = 3;
  EXPECT_EQ(search(100), 3U);
}

TEST_F(SeedSearch, NothingAvailableIsNothingTried) {
  cells_.claimed.assign(16, true);
  EXPECT_EQ(search(100), 0U);
  EXPECT_TRUE(cells_.tried.empty());
}

}  // namespace
}  // namespace dominant_plane_detection
