#include "core/seed_selection.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dominant_plane_detection {
namespace {

std::vector<std::size_t> drawAll(RandomDraw& draw, std::size_t begin, std::size_t end) {
  std::vector<std::size_t> drawn;
  draw.setRange(begin, end);
  while (!draw.empty()) drawn.push_back(draw.draw());
  return drawn;
}

TEST(RandomDraw, DrawsEachIndexOfTheRangeOnce) {
  RandomDraw draw;
  draw.restart(5);
  std::vector<std::size_t> drawn = drawAll(draw, 20, 120);
  EXPECT_FALSE(std::is_sorted(drawn.begin(), drawn.end()));
  std::sort(drawn.begin(), drawn.end());
  ASSERT_EQ(drawn.size(), 100U);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(drawn[i], 20 + i);
}

TEST(RandomDraw, RestartRepeatsAndSeedsDiffer) {
  RandomDraw draw;
  draw.restart(5);
  const auto first = drawAll(draw, 0, 50);
  EXPECT_NE(drawAll(draw, 0, 50), first);
  draw.restart(5);
  EXPECT_EQ(drawAll(draw, 0, 50), first);
  draw.restart(6);
  EXPECT_NE(drawAll(draw, 0, 50), first);
}

TEST(RandomDraw, NumbersAreEvenlyDistributed) {
  RandomDraw draw;
  draw.restart(1);
  std::vector<int> counts(10, 0);
  for (int i = 0; i < 100000; ++i) ++counts[draw.below(10)];
  // Ten standard deviations of a count of 10,000 expected.
  for (const int count : counts) EXPECT_NEAR(count, 10000, 950);
}

TEST(RandomDraw, AnEmptyRangeIsEmpty) {
  RandomDraw draw;
  draw.setRange(7, 7);
  EXPECT_TRUE(draw.empty());
}

}  // namespace
}  // namespace dominant_plane_detection
