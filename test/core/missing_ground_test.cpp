#include "core/missing_ground.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/detector_fixture.h"

namespace dominant_plane_detection {
namespace {

/// A floor with readings missing.
class HoledFloor : public testing::Test {
 protected:
  explicit HoledFloor(double height = kHeight)
      : height_(height), depth_(planeDepth(camera_, kUp, height)) {}

  /// @return [m] where a pixel meets the floor.
  Eigen::Vector3d onFloor(int u, int v) const {
    const Eigen::Vector3d ray = camera_.ray({u, v}).homogeneous();
    return -height_ / kUp.dot(ray) * ray;
  }
  /// Takes the readings of a square of the floor away.
  /// @param u, v pixel that sees its middle.
  /// @param side [m]
  void cutHole(int u, int v, double side, float reading = 0.0F) {
    const Eigen::Vector3d middle = onFloor(u, v);
    const Eigen::Vector3d across = kUp.cross(Eigen::Vector3d::UnitZ()).normalized();
    visit([&](int x, int y) {
      const Eigen::Vector3d r = onFloor(x, y) - middle;
      if (kUp.dot(camera_.ray({x, y}).homogeneous()) < -0.05 &&
          std::abs(r.dot(across)) < 0.5 * side && std::abs(r.dot(kUp.cross(across))) < 0.5 * side) {
        depth_.at(x, y) = reading;
      }
    });
  }
  void fill(int left, int top, int right, int bottom, float reading) {
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) depth_.at(u, v) = reading;
    }
  }
  const Detection& detect() {
    const Detection& detection = detector_.detect(depth_.view(), camera_);
    EXPECT_TRUE(detection.found());
    missing_ = 0;
    visit([&](int u, int v) { missing_ += detection.label(u, v) == Label::kMissingGround; });
    return detection;
  }
  /// @return [-] of the pixels without a reading in a rectangle, those called missing ground.
  double share(const Detection& detection, int left, int top, int right, int bottom) {
    int holes = 0, told = 0;
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) {
        if (depth_.at(u, v) > 0.0F) continue;
        ++holes;
        told += detection.label(u, v) == Label::kMissingGround;
      }
    }
    return static_cast<double>(told) / holes;
  }
  template <typename Visit>
  void visit(Visit&& visit) const {
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) visit(u, v);
    }
  }

  CameraModel camera_ = testCamera();
  double height_;
  OwnedDepth<float> depth_;
  DominantPlaneDetector detector_;
  int missing_ = 0;  ///< [px]
};

TEST_F(HoledFloor, HolesAreTold) {
  cutHole(320, 330, 0.2);
  cutHole(100, 160, 0.2);  // 2.2 m away
  const Detection& detection = detect();
  EXPECT_LT(onFloor(100, 160).z(), 2.5);
  EXPECT_GT(onFloor(100, 160).z(), 2.0);
  EXPECT_GE(share(detection, 0, 250, 640, 480), 0.95);
  EXPECT_GE(share(detection, 0, 100, 640, 250), 0.95);
  int elsewhere = 0;
  visit([&](int u, int v) {
    elsewhere += detection.label(u, v) == Label::kMissingGround && depth_.at(u, v) > 0.0F;
  });
  EXPECT_EQ(elsewhere, 0);
}

TEST_F(HoledFloor, OfAnyPixelType) {
  cutHole(320, 330, 0.2);
  const int as_metres = (detect(), missing_);
  const auto millimetres = inMillimetres(depth_);
  const Detection& detection = detector_.detect(millimetres.view(), camera_);
  int missing = 0;
  visit([&](int u, int v) { missing += detection.label(u, v) == Label::kMissingGround; });
  EXPECT_EQ(missing, as_metres);
  cutHole(320, 330, 0.2, std::numeric_limits<float>::quiet_NaN());
  detect();
  EXPECT_EQ(missing_, as_metres);
}

/// REP 118: too far to measure is no missing reading.
TEST_F(HoledFloor, WhatIsTooFarIsNotMissing) {
  cutHole(320, 330, 0.2, std::numeric_limits<float>::infinity());
  detect();
  EXPECT_EQ(missing_, 0);
}

TEST_F(HoledFloor, SmallerOnesAreNot) {
  cutHole(320, 330, 0.07);
  detect();
  EXPECT_EQ(missing_, 0);
  cutHole(320, 330, 0.09);
  detect();
  EXPECT_GT(missing_, 0);
}

/// A box that hides a strip of the floor from the sensor's other eye, on either side.
TEST_F(HoledFloor, WhatAnObstacleHidesIsNotMissing) {
  const double floor = onFloor(320, 300).z();
  const double parallax = 525.0 * 0.075 * (1.0 / 0.6 - 1.0 / floor);
  ASSERT_GT(parallax, 20.0);
  const int width = static_cast<int>(parallax);
  fill(250, 150, 350, 300, 0.6F);
  fill(250 - width, 150, 250, 300, 0.0F);
  detect();
  EXPECT_EQ(missing_, 0);
  depth_ = planeDepth(camera_, kUp, kHeight);
  fill(250, 150, 350, 300, 0.6F);
  fill(350, 150, 350 + width, 300, 0.0F);
  detect();
  EXPECT_EQ(missing_, 0);
  // Three times as wide is more than it hides.
  fill(350, 150, 350 + 3 * width, 300, 0.0F);
  const Detection& detection = detect();
  EXPECT_GE(share(detection, 350 + 2 * width, 150, 350 + 3 * width, 300), 0.95);
  EXPECT_EQ(detection.label(352, 200), Label::kUnknown);
}

/// The stripe where some sensors never see anything; but a hole that the border cuts is one.
TEST_F(HoledFloor, TheImagesBorderIsNoGround) {
  fill(0, 0, 40, 480, 0.0F);
  fill(0, 470, 640, 480, 0.0F);
  detect();
  EXPECT_EQ(missing_, 0);
  depth_ = planeDepth(camera_, kUp, kHeight);
  fill(300, 400, 400, 480, 0.0F);
  EXPECT_GE(share(detect(), 300, 400, 400, 480), 0.95);
}

TEST_F(HoledFloor, WhatIsAmongObstaclesIsNot) {
  fill(200, 150, 500, 400, 0.7F);
  fill(300, 200, 400, 350, 0.0F);
  detect();
  EXPECT_EQ(missing_, 0);
}

TEST_F(HoledFloor, WhatIsOutOfRangeIsNot) {
  Parameters parameters;
  parameters.range_max = onFloor(320, 320).z();
  detector_ = DominantPlaneDetector(parameters);
  cutHole(320, 300, 0.1);  // all of it is beyond
  detect();
  EXPECT_EQ(missing_, 0);
  parameters.range_max = 4.0;
  parameters.range_min = onFloor(320, 280).z();
  detector_ = DominantPlaneDetector(parameters);
  detect();
  EXPECT_EQ(missing_, 0);
}

TEST_F(HoledFloor, IsNotLookedForUnlessWanted) {
  Parameters parameters;
  parameters.missing_ground = false;
  detector_ = DominantPlaneDetector(parameters);
  cutHole(320, 330, 0.2);
  detect();
  EXPECT_EQ(missing_, 0);
}

/// Blocks that a hole only touches belong to it.
TEST_F(HoledFloor, ToTheLastPixel) {
  fill(301, 299, 346, 341, 0.0F);
  const Detection& detection = detect();
  EXPECT_EQ(missing_, 45 * 42);
  EXPECT_EQ(detection.label(301, 299), Label::kMissingGround);
  EXPECT_EQ(detection.label(345, 340), Label::kMissingGround);
}

/// Far away a single block is as large as the smallest piece.
TEST_F(HoledFloor, SpecksFarAwayAreNot) {
  height_ = 0.3;
  depth_ = planeDepth(camera_, kUp, height_);
  int v = 0;
  while (onFloor(320, v).z() > 3.9) ++v;
  v += 4 - v % 4;
  fill(320, v, 324, v + 4, 0.0F);
  detect();
  EXPECT_EQ(missing_, 0);
  fill(320, v, 336, v + 12, 0.0F);
  detect();
  EXPECT_EQ(missing_, 16 * 12);
}

/// Beside a hole depth may be smeared or unknown.
TEST_F(HoledFloor, GroundMayBeginSomeBlocksAway) {
  fill(300, 292, 348, 348, 0.2F);  // too near to be trusted
  fill(300, 300, 348, 340, 0.0F);
  const Detection& detection = detect();
  EXPECT_EQ(missing_, 48 * 40);
  EXPECT_EQ(detection.label(320, 295), Label::kUnknown);
}

/// Of a hole that is cut by the range only the part within is told.
TEST_F(HoledFloor, OnlyWithinTheRange) {
  Parameters parameters;
  parameters.range_max = onFloor(320, 300).z();
  detector_ = DominantPlaneDetector(parameters);
  fill(280, 240, 360, 380, 0.0F);
  const Detection& detection = detect();
  EXPECT_EQ(detection.label(320, 340), Label::kMissingGround);
  visit([&](int u, int v) {
    if (detection.label(u, v) == Label::kMissingGround) {
      EXPECT_LE(onFloor(u, v).z(), parameters.range_max + 1e-3) << u << ", " << v;
    }
  });
  EXPECT_GT(missing_, 0);
}

/// Stripes at both borders: where one row ends the next begins.
TEST_F(HoledFloor, AShadowAtTheLeftBorderIsOne) {
  fill(632, 0, 640, 480, 0.0F);
  fill(0, 240, 160, 280, 0.0F);
  fill(160, 230, 240, 290, 0.6F);
  const Detection& detection = detect();
  EXPECT_EQ(detection.label(80, 260), Label::kMissingGround);
  EXPECT_EQ(detection.label(155, 260), Label::kUnknown);
}

/// What no camera measures hides nothing.
TEST_F(HoledFloor, TinyReadingsAreNone) {
  cutHole(320, 330, 0.2);
  const int whole = (detect(), missing_);
  depth_.at(318, 330) = std::numeric_limits<float>::denorm_min();
  detect();
  EXPECT_EQ(missing_, whole - 1);
}

TEST_F(HoledFloor, PaddedRows) {
  cutHole(320, 330, 0.2);
  const int packed = (detect(), missing_);
  std::vector<float> padded(480 * 700, 0.0F);
  for (int v = 0; v < 480; ++v) std::copy_n(&depth_.at(0, v), 640, &padded[v * 700]);
  const Detection& detection =
      detector_.detect(DepthView(padded.data(), 640, 480, 700 * sizeof(float)), camera_);
  EXPECT_EQ(std::count(detection.labels.begin(), detection.labels.end(),
                       static_cast<std::uint8_t>(Label::kMissingGround)),
            packed);
}

/// A size that is no multiple of a block's.
TEST_F(HoledFloor, OddSizes) {
  camera_ = testCamera(641, 479);
  depth_ = planeDepth(camera_, kUp, kHeight);
  fill(600, 300, 641, 360, 0.0F);
  const Detection& detection = detector_.detect(depth_.view(), camera_);
  ASSERT_TRUE(detection.found());
  for (int v = 304; v < 356; ++v) {
    for (int u = 604; u < 641; ++u) {
      ASSERT_EQ(detection.label(u, v), Label::kMissingGround) << u << ", " << v;
    }
  }
}

}  // namespace
}  // namespace dominant_plane_detection
