#include "core/plane_fusion.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "support/synthetic_depth.h"

namespace dominant_plane_detection {
namespace {

const Eigen::Vector3d kNormal = upOf(0.4, 0.1).normalized();
constexpr double kDistance = 0.8;
constexpr double kAngle = 0.01;   // [rad]
constexpr double kHeight = 0.02;  // [m]

/// @param angle [rad] @param height [m] standard deviations, independent of each other.
Eigen::Matrix4d covarianceOf(const Eigen::Vector3d& normal, double angle, double height) {
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  covariance.topLeftCorner<3, 3>() =
      angle * angle * (Eigen::Matrix3d::Identity() - normal * normal.transpose());
  covariance(3, 3) = height * height;
  return covariance;
}

UncertainPlane seen() { return {kNormal, kDistance, covarianceOf(kNormal, kAngle, kHeight)}; }

/// @param turn [rad] about an axis across the normal. @param lift [m]
Prior::PredictedPlane predicted(double turn, double lift, double weight, double scale = 1.0) {
  const Eigen::Vector3d normal = Eigen::AngleAxisd(turn, kNormal.unitOrthogonal()) * kNormal;
  return {normal, kDistance + lift, covarianceOf(normal, scale * kAngle, scale * kHeight), weight};
}

TEST(PlaneFusion, EquallySurePlanesAreAveragedByTheWeight) {
  for (const double weight : {0.25, 0.5, 0.9}) {
    const UncertainPlane fused = fuse(seen(), predicted(0.01, 0.02, weight));
    EXPECT_NEAR(fused.distance, kDistance + weight * 0.02, 1e-9);
    EXPECT_NEAR(std::acos(fused.normal.dot(kNormal)), weight * 0.01, 1e-5);
    EXPECT_NEAR(fused.normal.norm(), 1.0, 1e-12);
    // No surer than either: both may have the same error.
    EXPECT_NEAR(fused.covariance(3, 3), kHeight * kHeight, 1e-9);
    const Eigen::Matrix3d of_normal = fused.covariance.topLeftCorner<3, 3>();
    EXPECT_NEAR(of_normal.trace(), 2.0 * kAngle * kAngle, 1e-7);
    EXPECT_NEAR((of_normal * fused.normal).norm(), 0.0, 1e-12);
  }
}

TEST(PlaneFusion, ASurerPredictionCountsMore) {
  // Half of an information four times as large: 4 / (1 + 4) of the way.
  const UncertainPlane fused = fuse(seen(), predicted(0.01, 0.02, 0.5, 0.5));
  EXPECT_NEAR(fused.distance, kDistance + 0.8 * 0.02, 1e-9);
  EXPECT_NEAR(std::acos(fused.normal.dot(kNormal)), 0.8 * 0.01, 1e-5);
  EXPECT_NEAR(fused.covariance(3, 3), kHeight * kHeight / 2.5, 1e-9);
}

TEST(PlaneFusion, WhatDisagreesWhatIsUnknownAndWhatHasNoWeightIsLeftOut) {
  const auto untouched = [](const UncertainPlane& fused) {
    return fused.normal == kNormal && fused.distance == kDistance;
  };
  EXPECT_TRUE(untouched(fuse(seen(), predicted(0.01, 0.02, 0.0))));
  // chi squared is (lift / kHeight)^2 / 2 here; the limit 11.34 is at 95 mm.
  EXPECT_FALSE(untouched(fuse(seen(), predicted(0.0, 0.094, 0.5))));
  EXPECT_TRUE(untouched(fuse(seen(), predicted(0.0, 0.097, 0.5))));
  Prior::PredictedPlane unknown = predicted(0.0, 0.01, 0.5);
  unknown.covariance = unknownCovariance();
  EXPECT_TRUE(untouched(fuse(seen(), unknown)));
  UncertainPlane unsure = seen();
  unsure.covariance = unknownCovariance();
  EXPECT_EQ(fuse(unsure, predicted(0.0, 0.01, 0.5)).distance, kDistance);
}

}  // namespace
}  // namespace dominant_plane_detection
