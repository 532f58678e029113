#include "prior/turn_history.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dominant_plane_detection {
namespace {

const Eigen::Vector3d kAxis = Eigen::Vector3d(0.3, -0.5, 0.8).normalized();

/// @return [rad] about the axis.
double angleOf(const Eigen::Quaterniond& turn) { return 2.0 * std::asin(turn.vec().dot(kAxis)); }

TEST(TurnHistory, RatesAreIntegratedBetweenTheirStamps) {
  TurnHistory history;
  EXPECT_FALSE(history.turn(0.0, 0.1));
  for (int i = 0; i <= 50; ++i) history.add(0.01 * i, (i <= 25 ? 1.0 : 2.0) * kAxis);
  EXPECT_NEAR(angleOf(*history.turn(0.0, 0.25)), 0.25, 1e-9);
  EXPECT_NEAR(angleOf(*history.turn(0.105, 0.205)), 0.1, 1e-9);
  EXPECT_NEAR(angleOf(*history.turn(0.2, 0.3)), 0.05 + 0.1, 1e-9);
  EXPECT_NEAR(angleOf(*history.turn(0.3, 0.2)), -0.15, 1e-9);
  EXPECT_NEAR(angleOf(*history.turn(0.4, 0.53)), 0.26, 1e-9);  // the last rate goes on
  EXPECT_FALSE(history.turn(0.4, 0.6));
  EXPECT_FALSE(history.turn(-0.1, 0.4));
}

TEST(TurnHistory, TheSensorsFrameAtTheBeginningIsTheOneItIsGivenIn) {
  TurnHistory history;
  history.add(0.0, Eigen::Vector3d::Zero());
  history.add(0.1, M_PI / 0.2 * Eigen::Vector3d::UnitX());
  history.add(0.2, M_PI / 0.2 * Eigen::Vector3d::UnitY());
  // A quarter turn about x, then one about the new y: the new z is where x was.
  const Eigen::Quaterniond turn = *history.turn(0.0, 0.2);
  EXPECT_LT((turn * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 1e-9);
}

TEST(TurnHistory, ASecondIsKeptAndAGapOrTimeThatGoesBackBeginsAnew) {
  TurnHistory history;
  for (int i = 0; i <= 150; ++i) history.add(0.01 * i, kAxis);
  EXPECT_TRUE(history.turn(0.55, 1.5));
  EXPECT_FALSE(history.turn(0.4, 1.5));
  history.add(0.7, kAxis);
  EXPECT_FALSE(history.turn(0.6, 0.7));
  history.add(0.8, kAxis);
  EXPECT_NEAR(angleOf(*history.turn(0.7, 0.8)), 0.1, 1e-9);
  history.add(1.9, kAxis);
  EXPECT_FALSE(history.turn(0.8, 1.9));
  history.add(2.0, Eigen::Vector3d::Constant(NAN));
  EXPECT_FALSE(history.turn(1.9, 2.0));
}

}  // namespace
}  // namespace dominant_plane_detection
