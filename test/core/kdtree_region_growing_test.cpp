// Algorithm 1 against its definition, carried out literally.

#include "core/kdtree_region_growing.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

namespace dominant_plane_detection {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Seeds = std::array<std::size_t, 3>;

/// All that the two tests of the algorithm look at, from all points of the region at once.
struct Refit {
  double mean_square_error = 0.0;
  double distance = 0.0;  ///< [m] of the last point to the plane
};

Refit refit(const Points& points, const std::vector<std::size_t>& region) {
  const auto k = static_cast<double>(region.size());
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  for (const std::size_t i : region) g += points[i] / k;  // Eq. 6
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  for (const std::size_t i : region) a += (points[i] - g) * (points[i] - g).transpose();  // Eq. 5
  const Eigen::Vector3d n = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(a).eigenvectors().col(0);
  Refit result;
  for (const std::size_t i : region) {
    result.mean_square_error += std::pow(n.dot(points[i] - g), 2) / k;  // Eq. 8
  }
  result.distance = std::abs(n.dot(points[region.back()] - g));
  return result;
}

/// At every step: the untested point nearest to the region, of those closer than delta to a point
/// of it, tested with everything computed anew.
/// @param claimed points of earlier regions.
std::vector<std::size_t> growNaively(const Points& points, const Seeds& seeds,
                                     const GrowthThresholds& thresholds,
                                     const std::vector<std::size_t>& claimed = {}) {
  const NoiseModel& noise = thresholds.noise;
  std::vector<std::size_t> region(seeds.begin(), seeds.end());
  std::vector<bool> tested(points.size(), false);
  for (const std::size_t seed : seeds) tested[seed] = true;
  for (const std::size_t point : claimed) tested[point] = true;
  while (true) {
    double nearest_distance = std::numeric_limits<double>::infinity();
    std::size_t nearest = points.size();
    for (std::size_t candidate = 0; candidate < points.size(); ++candidate) {
      if (tested[candidate]) continue;
      for (const std::size_t member : region) {
        const double distance = (points[candidate] - points[member]).norm();
        if (distance < thresholds.delta.at(points[member].z(), noise) &&
            distance < nearest_distance) {
          nearest_distance = distance;
          nearest = candidate;
        }
      }
    }
    if (nearest == points.size()) return region;
    tested[nearest] = true;
    region.push_back(nearest);
    double epsilon2 = 0.0;
    for (const std::size_t i : region) {
      epsilon2 += std::pow(thresholds.epsilon.at(points[i].z(), noise), 2) /
                  static_cast<double>(region.size());
    }
    const Refit fit = refit(points, region);
    if (fit.mean_square_error >= epsilon2 ||
        fit.distance >= thresholds.gamma.at(points[nearest].z(), noise)) {
      region.pop_back();
    }
  }
}

constexpr int kColumns = 24;
constexpr int kRows = 18;

/// A small image of a floor, by its number also with a wall behind a crease, a box, gaps, clutter.
Points smallImage(unsigned number) {
  std::mt19937 generator(number);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform;
  const double pitch = 0.3 + 0.5 * uniform(generator);
  const Eigen::Vector3d down(0.2 * gauss(generator) * 0.5, std::cos(pitch), std::sin(pitch));
  const double height = 0.5 + uniform(generator);
  const NoiseModel noise;
  Points points;
  for (int v = 0; v < kRows; ++v) {
    for (int u = 0; u < kColumns; ++u) {
      const Eigen::Vector3d ray((u - 11.5) / 22.0, (v - 8.5) / 22.0, 1.0);
      double z = height / std::max(ray.dot(down), 0.05);
      if (number % 2 == 1) z = std::min(z, 1.2 * height / std::sin(pitch));            // wall
      if (number % 3 == 1 && u > 8 && u < 15 && v > 9 && v < 14) z *= 0.8;             // box
      if (number % 4 == 2 && uniform(generator) < 0.2) continue;                       // gaps
      if (number % 5 == 3 && uniform(generator) < 0.1) z *= uniform(generator) + 0.4;  // clutter
      if (z > 6.0) continue;
      z += noise.sigma(z) * 0.7 * gauss(generator);
      points.push_back(z * ray);
    }
  }
  return points;
}

Seeds drawSeeds(std::size_t size, unsigned number) {
  const std::size_t first = size / 2 + (number * 37U) % (size / 2 - 30);
  return {first, first + 2, first + 25};
}

class SmallImage : public testing::TestWithParam<unsigned> {};

TEST_P(SmallImage, JoinsTheSamePointsInTheSameOrderAsTheDefinition) {
  const unsigned number = GetParam();
  const Points points = smallImage(number);
  KdtreeRegionGrowing growing;
  growing.setPoints(points);
  // Scaled with the noise; the same with wide steps; and constant as in the paper.
  const GrowthThresholds all_thresholds[] = {
      {NoiseModel(), {0.0, 60.0}, {0.0, 1.0}, {0.0, 3.0}},
      {NoiseModel(), {0.1, 30.0}, {0.0, 1.5}, {0.0, 2.0}},
      {NoiseModel(), {0.25, 0.0}, {0.008, 0.0}, {0.015, 0.0}}};
  for (const GrowthThresholds& thresholds : all_thresholds) {
    const Seeds seeds = drawSeeds(points.size(), number);
    growing.setPoints(points);  // forgets the claims
    EXPECT_EQ(growing.grow(seeds, thresholds).sequence, growNaively(points, seeds, thresholds));
  }
}

TEST_P(SmallImage, LaterRegionsAreThoseOfThePointsThatAreLeft) {
  const Points points = smallImage(GetParam());
  const GrowthThresholds thresholds{NoiseModel(), {0.1, 30.0}, {0.0, 1.0}, {0.0, 1.5}};
  KdtreeRegionGrowing growing;
  growing.setPoints(points);
  std::vector<std::size_t> claimed;
  for (std::size_t first = 0; first + 30 < points.size(); first += 41) {
    const Seeds seeds{first, first + 2, first + 25};
    if (growing.claimed(seeds[0]) || growing.claimed(seeds[1]) || growing.claimed(seeds[2])) {
      continue;
    }
    const std::vector<std::size_t> sequence = growing.grow(seeds, thresholds).sequence;
    EXPECT_EQ(sequence, growNaively(points, seeds, thresholds, claimed));
    claimed.insert(claimed.end(), sequence.begin(), sequence.end());
    EXPECT_EQ(growing.unclaimed() + claimed.size(), points.size());
  }
  for (const std::size_t point : claimed) EXPECT_TRUE(growing.claimed(point));
  EXPECT_GE(claimed.size(), 6U);  // of two regions at least
}

INSTANTIATE_TEST_SUITE_P(Numbers, SmallImage, testing::Range(0U, 24U));

TEST(KdtreeRegionGrowing, RegionsAreWorthComparing) {
  std::size_t joined = 0, rejected = 0;
  for (unsigned number = 0; number < 24; ++number) {
    const Points points = smallImage(number);
    KdtreeRegionGrowing growing;
    growing.setPoints(points);
    const auto& region = growing.grow(drawSeeds(points.size(), number),
                                      {NoiseModel(), {0.0, 60.0}, {0.0, 1.0}, {0.0, 3.0}});
    rejected += growing.effort().tests + 3 - region.sequence.size();
    joined += region.sequence.size();
  }
  // Of 24 images with up to 432 points each.
  EXPECT_GT(joined, 3000U);
  EXPECT_GT(rejected, 300U);
}

TEST(KdtreeRegionGrowing, MomentsAreThoseOfTheSequence) {
  const Points points = smallImage(1);
  KdtreeRegionGrowing growing;
  growing.setPoints(points);
  const auto& region = growing.grow(drawSeeds(points.size(), 1),
                                    {NoiseModel(), {0.0, 60.0}, {0.0, 1.0}, {0.0, 3.0}});
  PlaneMoments moments;
  for (const std::size_t point : region.sequence) moments.add(points[point]);
  EXPECT_EQ(region.moments.count(), moments.count());
  EXPECT_EQ(region.moments.scatter(), moments.scatter());
}

/// Three dense patches of a floor, 4 and 12 cm apart, with points 1 cm apart and some noise.
Points patches() {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.001);
  Points points;
  for (const double left : {0.0, 0.13, 0.34}) {
    for (int v = 0; v < 10; ++v) {
      for (int u = 0; u < 10; ++u) {
        points.emplace_back(left + 0.01 * u + noise(generator), 1.0 + noise(generator),
                            1.0 + 0.01 * v + noise(generator));
      }
    }
  }
  return points;
}

TEST(KdtreeRegionGrowing, CrossesGapsThatAreNarrowerThanDelta) {
  const Points points = patches();
  const Seeds seeds{0, 1, 10};
  KdtreeRegionGrowing growing;
  growing.setPoints(points);
  // In [m], and the patches that are reached; the last is reached from the second alone.
  for (const auto& [delta, reached] : {std::pair(0.03, 1U), {0.06, 2U}, {0.15, 3U}}) {
    const GrowthThresholds thresholds{NoiseModel(), {delta, 0.0}, {0.005, 0.0}, {0.01, 0.0}};
    growing.setPoints(points);
    const std::vector<std::size_t>& sequence = growing.grow(seeds, thresholds).sequence;
    EXPECT_EQ(sequence.size(), 100U * reached) << "delta " << delta;
    EXPECT_EQ(sequence, growNaively(points, seeds, thresholds)) << "delta " << delta;
  }
}

TEST(KdtreeRegionGrowing, FewDecompositionsOnALargeNoisyPlane) {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.002);
  Points points;
  for (int v = 0; v < 200; ++v) {
    for (int u = 0; u < 200; ++u)
      points.emplace_back(0.01 * u, 1.0 + noise(generator), 1.0 + 0.01 * v);
  }
  KdtreeRegionGrowing growing;
  growing.setPoints(points);
  const auto& region =
      growing.grow({20100, 20105, 21100}, {NoiseModel(), {0.05, 0.0}, {0.005, 0.0}, {0.01, 0.0}});
  EXPECT_GT(region.sequence.size(), 39900U);
  EXPECT_LT(growing.effort().decompositions * 20, growing.effort().tests);
}

/// A grid of points 1 cm apart.
Points sheet(int columns, int rows) {
  Points points;
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < columns; ++u) points.emplace_back(0.01 * u, 1.0, 1.0 + 0.01 * v);
  }
  return points;
}
const GrowthThresholds kFine{NoiseModel(), {0.015, 0.0}, {0.005, 0.0}, {0.01, 0.0}};

TEST(KdtreeRegionGrowing, RegionsAreCheckedAt200PointsAndAtEachDoubling) {
  KdtreeRegionGrowing growing;
  growing.setPoints(sheet(40, 25));
  std::vector<double> checked;
  const auto record = [&](const PlaneMoments& moments) {
    checked.push_back(moments.count());
    return true;
  };
  EXPECT_EQ(growing.grow({0, 1, 40}, kFine, record).sequence.size(), 1000U);
  EXPECT_EQ(checked, (std::vector<double>{200.0, 400.0, 800.0}));
}

TEST(KdtreeRegionGrowing, WhatIsGivenUpStaysClaimed) {
  KdtreeRegionGrowing growing;
  growing.setPoints(sheet(40, 25));
  const auto give_up = [](const PlaneMoments&) { return false; };
  EXPECT_EQ(growing.grow({0, 1, 40}, kFine, give_up).sequence.size(), 200U);
  EXPECT_EQ(growing.unclaimed(), 800U);
  EXPECT_TRUE(growing.claimed(0) && !growing.claimed(999));
  EXPECT_EQ(growing.grow({999, 998, 959}, kFine).sequence.size(), 800U);
  EXPECT_EQ(growing.unclaimed(), 0U);
}

/// What was waiting to be tested when a region was given up is no candidate of the next one.
TEST(KdtreeRegionGrowing, AfterOneThatIsGivenUpTheNextIsGrownByDefinition) {
  const Points points = sheet(30, 12);
  KdtreeRegionGrowing growing;
  growing.setPoints(points);
  const std::vector<std::size_t> first =
      growing.grow({0, 1, 30}, kFine, [](const PlaneMoments&) { return false; }).sequence;
  ASSERT_EQ(first.size(), 200U);
  const Seeds seeds{359, 358, 329};
  for (const std::size_t seed : seeds) ASSERT_FALSE(growing.claimed(seed));
  EXPECT_EQ(growing.grow(seeds, kFine).sequence, growNaively(points, seeds, kFine, first));
}

TEST(KdtreeRegionGrowing, RejectedPointsAreLeftForOthers) {
  // A step of 3 cm, on the edge of which both sheets are near enough.
  Points points = sheet(40, 20);
  for (const Eigen::Vector3d& low : sheet(40, 20)) {
    points.emplace_back(low + Eigen::Vector3d(0.0, 0.03, 0.2));
  }
  GrowthThresholds thresholds = kFine;
  thresholds.delta.offset = 0.05;
  KdtreeRegionGrowing growing;
  growing.setPoints(points);
  EXPECT_EQ(growing.grow({0, 1, 40}, thresholds).sequence.size(), 800U);
  EXPECT_GT(growing.effort().tests, 850U);
  EXPECT_EQ(growing.grow({1599, 1598, 1559}, thresholds).sequence.size(), 800U);
}

TEST(KdtreeRegionGrowing, OneDecompositionRefusesManyPoints) {
  // All points of one sheet are candidates of the other, 3 cm apart, and none may join.
  Points points = sheet(40, 40);
  for (const Eigen::Vector3d& low : sheet(40, 40)) {
    points.emplace_back(low + Eigen::Vector3d(0.0, 0.03, 0.0));
  }
  GrowthThresholds thresholds = kFine;
  thresholds.delta.offset = 0.1;
  KdtreeRegionGrowing growing;
  growing.setPoints(points);
  EXPECT_EQ(growing.grow({0, 1, 40}, thresholds).sequence.size(), 1600U);
  EXPECT_EQ(growing.effort().tests, 3197U);
  EXPECT_LT(growing.effort().decompositions, 20U);
}

TEST(KdtreeRegionGrowing, FewSearchesWithEveryPointWithinDelta) {
  GrowthThresholds thresholds = kFine;
  thresholds.delta.offset = 1.0;
  KdtreeRegionGrowing growing;
  growing.setPoints(sheet(100, 50));
  EXPECT_EQ(growing.grow({0, 1, 100}, thresholds).sequence.size(), 5000U);
  EXPECT_LT(growing.effort().searches, 6 * growing.effort().tests);
}

/// A member whose neighbours are all its own asks for more and more of them at a time.
TEST(KdtreeRegionGrowing, FewSearchesForManyNeighboursOfOne) {
  Points points{{0.0, 1.0, 1.0}, {0.3, 1.0, 1.0}, {0.0, 1.0, 1.3}};
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> place(-0.05, 0.05);
  for (int i = 0; i < 1000; ++i) {
    points.emplace_back(place(generator), 1.05 + 0.01 * place(generator), 1.0 + place(generator));
  }
  GrowthThresholds thresholds = kFine;
  thresholds.delta.offset = 0.1;
  KdtreeRegionGrowing growing;
  growing.setPoints(points);
  EXPECT_EQ(growing.grow({0, 1, 2}, thresholds).sequence.size(), 3U) << "all are off its plane";
  EXPECT_EQ(growing.effort().tests, 1000U);
  // Eight, 16 and 32 of the first member, and then 64 at a time; the others have none.
  EXPECT_LE(growing.effort().searches, 25U);
}

TEST(KdtreeRegionGrowing, DegenerateInputsGiveTheSeeds) {
  const GrowthThresholds wide{NoiseModel(), {1.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}};
  KdtreeRegionGrowing growing;
  Points line;
  for (int i = 0; i < 20; ++i) line.emplace_back(0.1 * i, 0.0, 1.0);
  growing.setPoints(line);
  EXPECT_EQ(growing.grow({3, 5, 9}, wide).sequence, (std::vector<std::size_t>{3, 5, 9}));

  growing.setPoints(Points(10, Eigen::Vector3d(0.1, 0.2, 1.0)));
  EXPECT_EQ(growing.grow({0, 1, 2}, wide).sequence, (std::vector<std::size_t>{0, 1, 2}));

  const Points three{{0.0, 1.0, 1.0}, {0.1, 1.0, 1.0}, {0.0, 1.0, 1.1}};
  growing.setPoints(three);
  EXPECT_EQ(growing.grow({2, 0, 1}, wide).sequence, (std::vector<std::size_t>{2, 0, 1}));

  Points four = three;
  four.emplace_back(0.0, 1.0, 3.0);  // farther than delta
  growing.setPoints(four);
  EXPECT_EQ(growing.grow({0, 1, 2}, wide).sequence.size(), 3U);
  GrowthThresholds no_reach = wide;
  no_reach.delta.offset = 0.0;
  growing.setPoints(four);
  EXPECT_EQ(growing.grow({0, 1, 3}, no_reach).sequence.size(), 3U);
}

}  // namespace
}  // namespace dominant_plane_detection
