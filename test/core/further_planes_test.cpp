// Further planes, their kinds and ramps that are ground, on scenes of exact planes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/detector_fixture.h"
#include "support/tile_scene.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// A floor, and a plane in a part of the image.
class FloorAndMore : public testing::Test {
 protected:
  FloorAndMore() : depth_(planeDepth(camera_, kUp, kHeight)) {
    parameters_.max_planes = 4;
    parameters_.range_min = 0.2;
    parameters_.range_max = 6.0;
  }

  /// Paints what is nearer than the floor or takes its place.
  /// @param normal [-] upwards or towards the camera. @param point [m] on the plane.
  void paint(const Eigen::Vector3d& normal, const Eigen::Vector3d& point, int left, int top,
             int right, int bottom) {
    paintPlane(depth_, camera_, HessePlane::through(point, -normal),
               [&](int u, int v) { return u >= left && u < right && v >= top && v < bottom; });
  }
  /// @return [m] where a pixel meets the floor, and so much higher.
  Eigen::Vector3d over(int u, int v, double height) const {
    const Eigen::Vector2d ray = camera_.ray({u, v});
    const Eigen::Vector3d direction(ray.x(), ray.y(), 1.0);
    return (height - kHeight) / kUp.dot(direction) * direction;
  }
  const Detection& detect() {
    detector_ = DominantPlaneDetector(parameters_);
    const Detection& detection = detector_.detect(depth_.view(), camera_);
    EXPECT_TRUE(detection.found());
    EXPECT_NEAR(detection.distance, kHeight, 0.003);
    return detection;
  }
  /// A plane that rises away from the camera, its foot along a row of the image.
  void paintRamp(double slope) {
    const Eigen::Vector3d foot = over(320, 300, 0.0);
    const Eigen::Vector3d across = kUp.cross(Eigen::Vector3d::UnitZ()).normalized();
    const Eigen::Vector3d normal = Eigen::AngleAxisd(-slope, across) * kUp;
    paintPlane(depth_, camera_, HessePlane::through(foot, -normal), [&](int u, int v) {
      const Eigen::Vector2d ray = camera_.ray({u, v});
      const Eigen::Vector3d direction(ray.x(), ray.y(), 1.0);
      const double floor = -kHeight / kUp.dot(direction);
      const double ramp = normal.dot(foot) / normal.dot(direction);
      return u >= 150 && u < 500 && v >= 100 && v < 400 && ramp > 0.0 && ramp < floor;
    });
  }

  const CameraModel camera_ = testCamera();
  OwnedDepth<float> depth_;
  Parameters parameters_;
  DominantPlaneDetector detector_;
};

TEST_F(FloorAndMore, ATableIsLevelAndHigh) {
  paint(kUp, over(320, 300, 0.5), 200, 200, 420, 400);
  const Detection& detection = detect();
  ASSERT_EQ(detection.further_planes.size(), 1U);
  const FurtherPlane& table = detection.further_planes.front();
  EXPECT_EQ(table.kind, PlaneKind::kTable);
  EXPECT_NEAR(table.distance, kHeight - 0.5, 0.001);
  EXPECT_LT(angle(table.normal, kUp), 0.001);
  EXPECT_NEAR(static_cast<double>(table.inliers), 220.0 * 200.0, 100.0);
  EXPECT_LT(table.mean_square_error, 1e-6);
  EXPECT_GT(table.covariance(3, 3), 0.0);
  ASSERT_EQ(detection.plane_index.size(), 640U * 480U);
  EXPECT_EQ(detection.plane_index[300 * 640 + 320], 2);
  EXPECT_EQ(detection.plane_index[450 * 640 + 320], 1);
  EXPECT_EQ(std::count(detection.plane_index.begin(), detection.plane_index.end(), 2),
            static_cast<std::ptrdiff_t>(table.inliers));
  EXPECT_EQ(std::count(detection.plane_index.begin(), detection.plane_index.end(), 1),
            static_cast<std::ptrdiff_t>(detection.inliers));
}

TEST_F(FloorAndMore, AStepIsLevelAndLow) {
  paint(kUp, over(320, 300, 0.15), 200, 200, 420, 400);
  ASSERT_EQ(detect().further_planes.size(), 1U);
  EXPECT_EQ(detect().further_planes.front().kind, PlaneKind::kStep);
  depth_ = planeDepth(camera_, kUp, kHeight);
  paint(kUp, over(320, 300, -0.15), 200, 200, 420, 400);
  ASSERT_EQ(detect().further_planes.size(), 1U);
  EXPECT_EQ(detect().further_planes.front().kind, PlaneKind::kStep) << "down";
}

TEST_F(FloorAndMore, AWallIsSteep) {
  const Eigen::Vector3d towards =
      (-Eigen::Vector3d::UnitZ() + kUp.z() * kUp).normalized();  // horizontal
  paint(towards, over(320, 200, 0.0), 0, 0, 640, 200);
  const Detection& detection = detect();
  ASSERT_EQ(detection.further_planes.size(), 1U);
  const FurtherPlane& wall = detection.further_planes.front();
  EXPECT_EQ(wall.kind, PlaneKind::kWall);
  EXPECT_LT(angle(wall.normal, towards), 0.001);
  EXPECT_EQ(std::count(detection.plane_index.begin(), detection.plane_index.end(), 1),
            static_cast<std::ptrdiff_t>(detection.inliers))
      << "at the foot, too";
  EXPECT_GT(wall.distance, 0.0);
}

/// Floor behind a wall-to-wall box that may not join.
TEST_F(FloorAndMore, FloorIsAsHighAsTheGround) {
  depth_ = cutFloor(camera_);
  parameters_.join_pieces = false;
  const Detection& detection = detect();
  ASSERT_GE(detection.further_planes.size(), 1U);
  EXPECT_EQ(detection.further_planes.front().kind, PlaneKind::kFloor);
  EXPECT_NEAR(detection.further_planes.front().distance, kHeight, 0.001);
}

/// What is not joined to the ground is level, though it is tilted by what an error may be.
TEST_F(FloorAndMore, ATiltedPlatformIsAStep) {
  const Eigen::Vector3d across = kUp.cross(Eigen::Vector3d::UnitZ()).normalized();
  paint(Eigen::AngleAxisd(-4.0 * kDegree, across) * kUp, over(320, 280, 0.12), 200, 180, 440, 420);
  const Detection& detection = detect();
  ASSERT_EQ(detection.further_planes.size(), 1U);
  EXPECT_EQ(detection.further_planes.front().kind, PlaneKind::kStep);
}

TEST_F(FloorAndMore, ARampRisesFromTheGround) {
  for (const double slope : {3.0, 8.0, 20.0}) {
    depth_ = planeDepth(camera_, kUp, kHeight);
    paintRamp(slope * kDegree);
    const Detection& detection = detect();
    ASSERT_EQ(detection.further_planes.size(), 1U) << slope;
    EXPECT_EQ(detection.further_planes.front().kind, PlaneKind::kRamp) << slope;
    EXPECT_NEAR(angle(detection.further_planes.front().normal, kUp), slope * kDegree, 0.003);
  }
}

TEST_F(FloorAndMore, ARampThatIsWantedIsGround) {
  paintRamp(8.0 * kDegree);
  const auto on_ramp = [](const Detection& detection) { return detection.label(320, 200); };
  EXPECT_NE(on_ramp(detect()), Label::kGround);
  for (const int planes : {1, 4}) {
    parameters_.max_planes = planes;
    parameters_.max_ramp = 10.0 * kDegree;
    const Detection& detection = detect();
    EXPECT_EQ(on_ramp(detection), Label::kGround) << planes;
    EXPECT_EQ(detection.further_planes.size(), static_cast<std::size_t>(planes > 1 ? 1 : 0));
    EXPECT_EQ(*std::max_element(detection.plane_index.begin(), detection.plane_index.end()),
              planes > 1 ? 2 : 1);
    EXPECT_EQ(std::count(detection.plane_index.begin(), detection.plane_index.end(), 1),
              static_cast<std::ptrdiff_t>(detection.inliers))
        << "the ramp is none of them";
    parameters_.max_ramp = 7.0 * kDegree;
    EXPECT_NE(on_ramp(detect()), Label::kGround) << "steeper than wanted";
  }
}

/// The same slope on a table: nothing leads there.
TEST_F(FloorAndMore, ARampThatDoesNotJoinIsNoGround) {
  parameters_.max_ramp = 20.0 * kDegree;
  const Eigen::Vector3d across = kUp.cross(Eigen::Vector3d::UnitZ()).normalized();
  paint(Eigen::AngleAxisd(8.0 * kDegree, across) * kUp, over(320, 300, 0.4), 200, 200, 420, 400);
  const Detection& detection = detect();
  ASSERT_EQ(detection.further_planes.size(), 1U);
  EXPECT_EQ(detection.further_planes.front().kind, PlaneKind::kRamp);
  EXPECT_EQ(detection.label(320, 300), Label::kObstacle);
}

TEST_F(FloorAndMore, TheLargestAreTold) {
  paint(kUp, over(320, 300, 0.15), 460, 200, 600, 350);
  paint(kUp, over(320, 300, 0.3), 280, 220, 420, 400);
  paint(kUp, over(320, 300, 0.5), 20, 250, 240, 450);
  const Detection& detection = detect();
  ASSERT_EQ(detection.further_planes.size(), 3U);
  EXPECT_GT(detection.further_planes[0].inliers, detection.further_planes[1].inliers);
  EXPECT_GT(detection.further_planes[1].inliers, detection.further_planes[2].inliers);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(std::count(detection.plane_index.begin(), detection.plane_index.end(), i + 2),
              static_cast<std::ptrdiff_t>(detection.further_planes[i].inliers));
  }
  EXPECT_NEAR(detection.further_planes[0].distance, kHeight - 0.5, 0.002);
  EXPECT_NEAR(detection.further_planes[1].distance, kHeight - 0.3, 0.002);
  EXPECT_NEAR(detection.further_planes[2].distance, kHeight - 0.15, 0.002);
  parameters_.max_planes = 2;
  const Detection& fewer = detect();
  ASSERT_EQ(fewer.further_planes.size(), 1U);
  EXPECT_NEAR(fewer.further_planes[0].distance, kHeight - 0.5, 0.002);
  EXPECT_EQ(*std::max_element(fewer.plane_index.begin(), fewer.plane_index.end()), 2);
}

/// A wall behind a pillar is one plane, and takes one place.
TEST_F(FloorAndMore, APlaneInTwoPiecesIsOne) {
  const Eigen::Vector3d towards = (-Eigen::Vector3d::UnitZ() + kUp.z() * kUp).normalized();
  paint(towards, over(320, 200, 0.0), 0, 0, 640, 200);
  paint(towards, over(320, 330, 0.0), 240, 0, 340, 330);
  for (const int planes : {2, 8}) {
    parameters_.max_planes = planes;
    const Detection& detection = detect();
    const auto walls =
        std::count_if(detection.further_planes.begin(), detection.further_planes.end(),
                      [&](const FurtherPlane& plane) {
                        return plane.kind == PlaneKind::kWall &&
                               std::abs(plane.distance + towards.dot(over(320, 200, 0.0))) < 0.01;
                      });
    EXPECT_EQ(walls, 1) << planes;
    EXPECT_EQ(detection.plane_index[100 * 640 + 50], detection.plane_index[100 * 640 + 600]);
    EXPECT_NE(detection.plane_index[100 * 640 + 50], 0);
  }
}

/// At any resolution.
TEST_F(FloorAndMore, SmallImagesHaveThemToo) {
  const CameraModel small = testCamera(160, 120);
  OwnedDepth<float> depth = planeDepth(small, kUp, kHeight);
  const Eigen::Vector2d ray = small.ray({80, 75});
  const Eigen::Vector3d direction(ray.x(), ray.y(), 1.0);
  const Eigen::Vector3d on_table = (0.4 - kHeight) / kUp.dot(direction) * direction;
  paintPlane(depth, small, HessePlane::through(on_table, -kUp),
             [](int u, int v) { return u >= 68 && u < 96 && v >= 60 && v < 88; });
  DominantPlaneDetector detector(parameters_);
  const Detection& detection = detector.detect(depth.view(), small);
  ASSERT_TRUE(detection.found());
  ASSERT_EQ(detection.further_planes.size(), 1U);
  EXPECT_EQ(detection.further_planes.front().kind, PlaneKind::kTable);
}

/// Where a lens cannot be inverted a pixel has no plane.
TEST_F(FloorAndMore, PixelsWithoutARayHaveNone) {
  CameraModel fisheye = camera_;
  fisheye.distortion = DistortionModel::kPlumbBob;
  fisheye.coefficients = {-0.9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  ASSERT_TRUE(std::isnan(fisheye.ray({0, 0}).x()));
  OwnedDepth<float> depth(640, 480);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const Eigen::Vector2d ray = fisheye.ray({u, v});
      const double down = -kUp.dot(Eigen::Vector3d(ray.x(), ray.y(), 1.0));
      depth.at(u, v) = down > 0.05 ? static_cast<float>(kHeight / down) : 1.0F;
    }
  }
  parameters_.max_ramp = 0.2;
  DominantPlaneDetector detector(parameters_);
  const Detection& detection = detector.detect(depth.view(), fisheye);
  ASSERT_TRUE(detection.found());
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      if (!std::isnan(fisheye.ray({u, v}).x())) continue;
      ASSERT_EQ(detection.plane_index[static_cast<std::size_t>(v * 640 + u)], 0);
      ASSERT_EQ(detection.label(u, v), Label::kUnknown);
    }
  }
  for (const FurtherPlane& plane : detection.further_planes) {
    EXPECT_TRUE(std::isfinite(plane.mean_square_error));
  }
}

TEST_F(FloorAndMore, ThereAreNoneUnlessAskedFor) {
  paint(kUp, over(320, 300, 0.5), 200, 200, 420, 400);
  parameters_.max_planes = 1;
  const Detection& detection = detect();
  EXPECT_TRUE(detection.further_planes.empty());
  EXPECT_TRUE(detection.plane_index.empty());
}

/// What is smaller than half of min_share is none; and nothing is left over from image to image.
TEST_F(FloorAndMore, SmallOnesAreNone) {
  paint(kUp, over(320, 300, 0.5), 300, 300, 370, 370);  // 1.6 %
  EXPECT_TRUE(detect().further_planes.empty());
  EXPECT_EQ(detect().plane_index[330 * 640 + 330], 0);
  parameters_.min_share = 0.02;
  ASSERT_EQ(detect().further_planes.size(), 1U);
  const OwnedDepth<float> empty(640, 480);
  const Detection& nothing = detector_.detect(empty.view(), camera_);
  EXPECT_TRUE(nothing.further_planes.empty());
  EXPECT_TRUE(nothing.plane_index.empty());
}

TEST_F(FloorAndMore, TheSameByEitherAlgorithm) {
  paint(kUp, over(320, 300, 0.5), 200, 200, 420, 400);
  parameters_.algorithm = Algorithm::kKdtree;
  const Detection& detection = detect();
  ASSERT_EQ(detection.further_planes.size(), 1U);
  EXPECT_EQ(detection.further_planes.front().kind, PlaneKind::kTable);
}

TEST(PlaneKinds, HaveNames) {
  EXPECT_STREQ(kindName(PlaneKind::kFloor), "floor");
  EXPECT_STREQ(kindName(PlaneKind::kRamp), "ramp");
  EXPECT_STREQ(kindName(PlaneKind::kStep), "step");
  EXPECT_STREQ(kindName(PlaneKind::kTable), "table");
  EXPECT_STREQ(kindName(PlaneKind::kWall), "wall");
}

}  // namespace
}  // namespace dominant_plane_detection
