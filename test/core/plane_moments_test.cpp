#include "core/plane_moments.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>
#include <vector>

#include "dominant_plane_detection/noise_model.h"

namespace dominant_plane_detection {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Points noisyPlane(std::size_t count, double sigma, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, sigma);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.1, 0.9, 0.4).normalized();
  const Eigen::Vector3d a = normal.unitOrthogonal(), b = normal.cross(a);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(4.0 * normal + spread(generator) * a + spread(generator) * b +
                     noise(generator) * normal);
  }
  return points;
}

/// Eq. 5 to 8 as they stand, from all points at once.
struct Naive {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  Eigen::Vector3d normal;
  double distance;
  double mean_square_error = 0.0;

  explicit Naive(const Points& points) {
    for (const auto& r : points) centre += r;
    centre /= static_cast<double>(points.size());                                     // Eq. 6
    for (const auto& r : points) scatter += (r - centre) * (r - centre).transpose();  // Eq. 5
    normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
    distance = normal.dot(centre);  // Eq. 7
    if (distance < 0.0) {
      normal = -normal;
      distance = -distance;
    }
    for (const auto& r : points) {  // Eq. 8
      const double error = normal.dot(r) - distance;
      mean_square_error += error * error / static_cast<double>(points.size());
    }
  }
};

TEST(PlaneMoments, Equation10EqualsRecomputingOver100000Points) {
  const Points points = noisyPlane(100000, 0.005, 1);
  PlaneMoments moments;
  // Eq. 10 as it is printed, beside the form the class keeps.
  Eigen::Vector3d s = Eigen::Vector3d::Zero();
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  double k = 0.0;
  for (const auto& r : points) {
    moments.add(r);
    const Eigen::Vector3d g_k = k > 0.0 ? Eigen::Vector3d(s / k) : Eigen::Vector3d::Zero();
    const Eigen::Vector3d s_next = s + r;
    const Eigen::Vector3d g_next = s_next / (k + 1.0);
    a += g_k * s.transpose() + r * r.transpose() - g_next * s_next.transpose();
    s = s_next;
    k += 1.0;
  }
  const Naive naive(points);
  const double scale = naive.scatter.norm();
  EXPECT_LT((a - naive.scatter).norm() / scale, 1e-9);
  EXPECT_LT((moments.scatter() - naive.scatter).norm() / scale, 1e-9);
  const auto fit = moments.fit();
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->plane.normal - naive.normal).norm(), 1e-9);
  EXPECT_NEAR(fit->plane.distance, naive.distance, 1e-9);
  EXPECT_LT((fit->centre - naive.centre).norm(), 1e-9);
  EXPECT_NEAR(fit->mean_square_error / naive.mean_square_error, 1.0, 1e-7);
  EXPECT_NEAR(std::sqrt(fit->mean_square_error), 0.005, 5e-5);
}

TEST(PlaneMoments, ThinPlaneFourMetresAwayKeepsItsThickness) {
  const Points points = noisyPlane(20000, 1e-4, 2);
  PlaneMoments moments;
  for (const auto& r : points) moments.add(r);
  EXPECT_NEAR(std::sqrt(moments.fit()->mean_square_error), 1e-4, 2e-6);
}

TEST(PlaneMoments, MergedBlocksEqualTheirPoints) {
  const Points points = noisyPlane(1000, 0.01, 3);
  PlaneMoments whole, merged, first, second;
  for (std::size_t i = 0; i < points.size(); ++i) {
    whole.add(points[i]);
    (i < 300 ? first : second).add(points[i]);
  }
  merged.merge(first);
  const Naive block(Points(points.begin() + 300, points.end()));
  merged.add(700.0, block.centre, block.scatter);
  EXPECT_EQ(merged.count(), whole.count());
  EXPECT_LT((merged.sum() - whole.sum()).norm(), 1e-9);
  EXPECT_LT((merged.scatter() - whole.scatter()).norm(), 1e-9);
}

TEST(PlaneMoments, WeightCountsAPointSeveralTimes) {
  const Points points = noisyPlane(50, 0.01, 4);
  PlaneMoments weighted, repeated;
  for (const auto& r : points) {
    weighted.add(r, 3.0);
    for (int i = 0; i < 3; ++i) repeated.add(r);
  }
  EXPECT_LT((weighted.scatter() - repeated.scatter()).norm(), 1e-10);
  EXPECT_NEAR(weighted.fit()->mean_square_error, repeated.fit()->mean_square_error, 1e-12);
}

TEST(PlaneMoments, NormalPointsAwayFromTheCamera) {
  PlaneMoments moments;
  for (const auto& r :
       {Eigen::Vector3d(0, 1, 1), Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 1, 2)})
    moments.add(r);
  const auto fit = moments.fit();
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->plane.normal.y(), 1.0, 1e-12);
  EXPECT_NEAR(fit->plane.distance, 1.0, 1e-12);
  EXPECT_NEAR(fit->plane.signedDistance({5.0, 0.25, 7.0}), -0.75, 1e-12);
}

TEST(PlaneMoments, NoPlaneThroughFewerThanThreePointsALineOrOnePlace) {
  PlaneMoments moments;
  EXPECT_FALSE(moments.fit());
  moments.add({0.3, 0.2, 4.0});
  EXPECT_FALSE(moments.fit());
  moments.add({0.5, -0.2, 3.0});
  EXPECT_FALSE(moments.fit());
  for (int i = 2; i < 50; ++i) moments.add({0.3 + 0.2 * i, 0.2 - 0.4 * i, 4.0 - i});
  EXPECT_FALSE(moments.fit());
  PlaneMoments one_place;
  for (int i = 0; i < 10; ++i) one_place.add({1.0, 1.1, 1.2});
  EXPECT_FALSE(one_place.fit());
}

TEST(NoiseModel, SigmaAndThresholds) {
  const NoiseModel noise;
  EXPECT_NEAR(noise.sigma(2.0), 0.002 + 1.425e-3 * 4.0, 1e-12);
  EXPECT_NEAR((DepthThreshold{0.0, 3.0}.at(2.0, noise)), 3.0 * noise.sigma(2.0), 1e-12);
  EXPECT_EQ((DepthThreshold{0.05, 0.0}.at(1.0, noise)), (DepthThreshold{0.05, 0.0}.at(4.0, noise)));
}

}  // namespace
}  // namespace dominant_plane_detection
