// What a detection does with what its robot knows, and what it tells the robot; on scenes whose
// truth is known.

#include <pcl_conversions/pcl_conversions.h>
#include <pcl_ros/point_cloud.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dominant_plane_detection/detection.h"
#include "robot_fixture.h"
#include "ros/robot_frames.h"
#include "support/diagnostics.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = M_PI / 180.0;

TEST_F(Robot, TfTellsUpAndTheHeightOfTheFloor) {
  sendMount(cameraInBase());
  Listener<DominantPlane> planes(node_, "/by_tf/plane");
  ASSERT_TRUE(ready(planes));
  const sensor_msgs::Image image = tableBeforeFloor();
  EXPECT_TRUE(sendUntil(planes, image, [](const DominantPlane& plane) {
    return isFrom(plane, DominantPlane::UP_TF, kHeight) && plane.tracked;
  }));
  // The same mount over a floor that would be the table.
  sendMount(cameraInBase(0.0, -0.3));
  EXPECT_TRUE(sendUntil(planes, image, [](const DominantPlane& plane) {
    return isFrom(plane, DominantPlane::UP_TF, 0.5);
  }));
  sendMount(cameraInBase());
}

TEST_F(Robot, GravityFindsTheLowestLevelPlane) {
  Listener<DominantPlane> planes(node_, "/by_gravity/plane");
  ASSERT_TRUE(ready(planes));
  ASSERT_TRUE(spinUntil([&] { return imus_.getNumSubscribers() > 0; }));
  EXPECT_TRUE(sendUntil(planes, tableBeforeFloor(), [](const DominantPlane& plane) {
    return isFrom(plane, DominantPlane::UP_IMU, kHeight) && plane.tracked;
  }));
  // Readings that are not of the image's time are passed over, and so is a track.
  stamp_ += ros::Duration(2.0);
  answered_ = [&] { return planes.last()->header.stamp; };
  sendImages(tableBeforeFloor(), 1, false);
  EXPECT_TRUE(isFrom(*planes.last(), DominantPlane::UP_FIXED, 0.5)) << planes.last()->distance;
  EXPECT_FALSE(planes.last()->tracked);
}

/// An inertial sensor with a frame and an orientation of its own, on the topic that comes first.
TEST_F(Robot, AnInertialSensorMayBeTurnedAndKnowItsOrientation) {
  const auto imus = node_.advertise<sensor_msgs::Imu>("/imu/data", 50);
  const Eigen::Quaterniond sensor(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  geometry_msgs::TransformStamped place =
      tf2::eigenToTransform(Eigen::Isometry3d(sensor));  // T_optical_imu
  place.header.frame_id = "optical";
  place.header.stamp = ros::Time(1, 0);
  place.child_frame_id = "imu_link";
  mounts_.sendTransform(place);
  Listener<DominantPlane> planes(node_, "/by_gravity/plane");
  ASSERT_TRUE(ready(planes));
  ASSERT_TRUE(spinUntil([&] { return imus.getNumSubscribers() > 0; }));
  const Eigen::Vector3d up = sensor.conjugate() * kUp;
  // The orientation is right, and what is felt is off by 14 degrees: more than a level plane may
  // be.
  const Eigen::Vector3d felt = 9.81 * (Eigen::AngleAxisd(14.0 * kDegree, up.unitOrthogonal()) * up);
  sensor_msgs::Imu imu;
  imu.header.frame_id = "imu_link";
  const Eigen::Quaterniond orientation =
      Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ());
  imu.orientation.w = orientation.w();
  imu.orientation.x = orientation.x();
  imu.orientation.y = orientation.y();
  imu.orientation.z = orientation.z();
  imu.linear_acceleration.x = felt.x();
  imu.linear_acceleration.y = felt.y();
  imu.linear_acceleration.z = felt.z();
  EXPECT_TRUE(sendUntil(planes, tableBeforeFloor(), [&](const DominantPlane& plane) {
    imu.header.stamp = stamp_ + ros::Duration(1.0 / 30.0);
    imus.publish(imu);
    return isFrom(plane, DominantPlane::UP_IMU, kHeight);
  }));
}

TEST_F(Robot, WithoutAnyThePlaneIsTheLargestAndTheLogSaysWhatIsMissing) {
  Listener<DominantPlane> planes(node_, "/by_nothing/plane");
  Listener<rosgraph_msgs::Log> logs(node_, "/rosout");
  ASSERT_TRUE(ready(planes));
  EXPECT_TRUE(sendUntil(planes, tableBeforeFloor(), [](const DominantPlane& plane) {
    return isFrom(plane, DominantPlane::UP_FIXED, 0.5);
  }));
  const auto said = [&] {
    return std::count_if(logs.messages().begin(), logs.messages().end(), [](const auto& line) {
      return line->level == rosgraph_msgs::Log::WARN &&
             line->msg.find("No tf from no_such_base to optical") != std::string::npos;
    });
  };
  sendImages(tableBeforeFloor(), 40);
  EXPECT_TRUE(spinUntil([&] { return said() > 0; }));
  sendImages(tableBeforeFloor(), 10);
  EXPECT_FALSE(planes.last()->tracked);
  EXPECT_EQ(said(), 1);
  Diagnostics diagnostics(node_);
  const std::string name = "by_nothing: detection";
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics.value(name, "up, what is passed over").find("no_such_base") !=
           std::string::npos;
  }));
  EXPECT_EQ(diagnostics.value(name, "up is known by"), "expected_up");
}

/// The box of the fixture against its own arithmetic.
TEST_F(Robot, TheScanIsInTheFrameOnTheGround) {
  sendMount(cameraInBase());
  Listener<DominantPlane> planes(node_, "/by_tf/plane");
  Listener<sensor_msgs::LaserScan> scans(node_, "/by_tf/scan");
  ASSERT_TRUE(ready(planes, scans));
  EXPECT_TRUE(sendUntil(planes, image_, [&](const DominantPlane& plane) {
    return isFrom(plane, DominantPlane::UP_TF, kHeight) && scans.size() > 0;
  }));
  // Its tf has the same stamp; the first ones may come before anybody hears them.
  ASSERT_TRUE(sendUntil(planes, image_, [&](const DominantPlane& plane) {
    return scans.last()->header.stamp == plane.header.stamp &&
           buffer_.canTransform("ground_by_tf", "optical", plane.header.stamp);
  }));
  const sensor_msgs::LaserScan& scan = *scans.last();
  EXPECT_EQ(scan.header.frame_id, "ground_by_tf");
  EXPECT_NEAR(
      static_cast<double>(scan.angle_max),
      static_cast<double>(scan.angle_min) + static_cast<double>(scan.angle_increment) *
                                                (static_cast<double>(scan.ranges.size()) - 1.0),
      1e-4);
  // It takes the camera to above the origin.
  const Eigen::Isometry3d ground =
      tf2::transformToEigen(buffer_.lookupTransform("ground_by_tf", "optical", scan.header.stamp));
  EXPECT_LT((ground.translation() - Eigen::Vector3d(0, 0, kHeight)).norm(), 0.002);
  EXPECT_LT((ground.linear() * kUp - Eigen::Vector3d::UnitZ()).norm(), 0.002);
  // In each direction the nearest of the box's points.
  const OwnedDepth<float> depth = sceneMetres();
  std::vector<double> nearest(scan.ranges.size(), std::numeric_limits<double>::infinity());
  for (int v = 200; v < 260; ++v) {
    for (int u = 300; u < 360; ++u) {
      const auto z = static_cast<double>(depth.pixels[static_cast<std::size_t>(v * 640 + u)]);
      const Eigen::Vector3d at = groundFromOptical(kUp, kHeight) *
                                 Eigen::Vector3d(z * testCamera().ray({u, v}).homogeneous());
      const double index = (std::atan2(at.y(), at.x()) - static_cast<double>(scan.angle_min)) /
                           static_cast<double>(scan.angle_increment);
      double& range = nearest.at(static_cast<std::size_t>(std::lround(index)));
      range = std::min(range, at.head<2>().norm());
    }
  }
  int readings = 0;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    const double range = static_cast<double>(scan.ranges[i]);
    const bool valid = static_cast<double>(scan.range_min) <= range &&
                       range <= static_cast<double>(scan.range_max);
    EXPECT_TRUE(valid || std::isnan(range) || range == INFINITY) << range;
    if (!valid) continue;
    ++readings;
    EXPECT_NEAR(range, nearest[i], 0.05) << i;
  }
  EXPECT_GE(readings, 10);
}

TEST_F(Robot, AFrameThatHasAParentIsLeftAlone) {
  geometry_msgs::TransformStamped taken = tf2::eigenToTransform(Eigen::Isometry3d::Identity());
  taken.header.frame_id = "map";
  taken.header.stamp = ros::Time(1, 0);
  taken.child_frame_id = "taken";
  mounts_.sendTransform(taken);
  Listener<DominantPlane> planes(node_, "/by_gravity/plane");
  Listener<sensor_msgs::LaserScan> scans(node_, "/by_gravity/scan");
  Listener<rosgraph_msgs::Log> logs(node_, "/rosout");
  ASSERT_TRUE(ready(planes, scans));
  const auto said = [&] {
    return std::any_of(logs.messages().begin(), logs.messages().end(), [](const auto& line) {
      return line->msg.find("No tf goes out from optical to taken") != std::string::npos;
    });
  };
  EXPECT_TRUE(sendUntil(planes, image_, [&](const DominantPlane&) { return said(); }));
  const std::size_t before = scans.size();
  sendImages(image_, 10);
  EXPECT_EQ(scans.size(), before);
  std::string parent;
  EXPECT_TRUE(buffer_._getParent("taken", ros::Time(0), parent));
  EXPECT_EQ(parent, "map");
}

/// Frames of old recordings have a slash before their names; and a camera may get another frame.
TEST_F(Robot, SlashesAndNewFramesAreNoConflict) {
  sendMount(cameraInBase());
  Listener<DominantPlane> planes(node_, "/by_tf/plane");
  Listener<sensor_msgs::LaserScan> scans(node_, "/by_tf/scan");
  ASSERT_TRUE(ready(planes, scans));
  for (const char* frame : {"/optical", "optical", "other_optical", "/optical"}) {
    frame_ = frame;
    const std::size_t before = scans.size();
    EXPECT_TRUE(sendUntil(planes, image_, [&](const DominantPlane& plane) {
      return scans.size() > before + 5 && plane.header.frame_id == frame &&
             isFrom(plane,
                    frame == std::string("other_optical") ? DominantPlane::UP_FIXED
                                                          : DominantPlane::UP_TF,
                    kHeight);
    })) << frame;
  }
}

TEST_F(Robot, AMountThatIsKnockedIsTold) {
  sendMount(cameraInBase());
  Listener<DominantPlane> planes(node_, "/by_tf/plane");
  Diagnostics diagnostics(node_);
  const std::string name = "by_tf: detection";
  ASSERT_TRUE(ready(planes));
  ASSERT_TRUE(sendUntil(planes, image_, [](const DominantPlane& plane) {
    return isFrom(plane, DominantPlane::UP_TF, kHeight);
  }));
  sendImages(image_, 120);
  EXPECT_EQ(diagnostics.value(name, "mount"), "");
  // tf that is wrong is as good as a mount that is.
  sendMount(cameraInBase(3.0 * kDegree, 0.0));
  sendImages(image_, 40);
  ASSERT_TRUE(spinUntil([&] { return !diagnostics.value(name, "mount").empty(); }));
  EXPECT_NE(diagnostics.value(name, "mount").find("mount moved"), std::string::npos);
  EXPECT_NE(diagnostics.value(name, "mount").find("0.0 deg (roll) and -3.0 deg (pitch)"),
            std::string::npos)
      << diagnostics.value(name, "mount");
  EXPECT_EQ(diagnostics.of(name)->level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_EQ(diagnostics.of(name)->message, diagnostics.value(name, "mount"));
  sendMount(cameraInBase());
  sendImages(image_, 40);
  EXPECT_TRUE(spinUntil([&] { return diagnostics.value(name, "mount").empty(); }));
}

TEST_F(Robot, CloudsComeInTheBaseWithColoursAndWithoutTheBody) {
  sendMount(cameraInBase());
  const auto pictures = node_.advertise<sensor_msgs::Image>("/image", 10);
  Listener<DominantPlane> planes(node_, "/in_base/plane");
  Listener<pcl::PointCloud<pcl::PointXYZRGB>> grounds(node_, "/in_base/ground");
  Listener<sensor_msgs::PointCloud2> raw(node_, "/in_base/ground");
  Listener<sensor_msgs::Image> labels(node_, "/in_base/labels");
  ASSERT_TRUE(ready(planes));
  ASSERT_TRUE(spinUntil(
      [&] { return grounds.connected() && raw.connected() && pictures.getNumSubscribers() > 0; }));
  sensor_msgs::Image picture;
  picture.encoding = "rgb8";
  picture.width = 640;
  picture.height = 480;
  picture.step = 3 * 640;
  for (int i = 0; i < 640 * 480; ++i) picture.data.insert(picture.data.end(), {10, 20, 30});
  picture.header.frame_id = "optical";
  const auto coloured = [&](const pcl::PointCloud<pcl::PointXYZRGB>& cloud) {
    return cloud.size() > 100 && std::all_of(cloud.begin(), cloud.end(), [](const auto& point) {
             return point.r == 10 && point.g == 20 && point.b == 30;
           });
  };
  ASSERT_TRUE(sendUntil(planes, image_, [&](const DominantPlane&) {
    picture.header.stamp = stamp_ + ros::Duration(1.0 / 30.0);
    pictures.publish(picture);
    return grounds.size() > 0 && coloured(*grounds.last());
  }));
  const auto& cloud = *grounds.last();
  EXPECT_EQ(cloud.header.frame_id, "base_link");
  EXPECT_EQ(raw.last()->fields.back().name, "rgb");
  // A ninth of the inliers.
  EXPECT_NEAR(static_cast<double>(cloud.size()), planes.last()->inliers / 9.0,
              0.02 * planes.last()->inliers);
  const Eigen::AlignedBox3f body(Eigen::Vector3f(0.3F, -0.1F, -0.04F),
                                 Eigen::Vector3f(0.75F, 0.1F, 0.3F));
  float nearest = 10.0F;
  for (const auto& point : cloud) {
    ASSERT_NEAR(point.z, 0.0F, 0.05F);
    ASSERT_FALSE(body.contains(point.getVector3fMap()));
    nearest = std::min(nearest, point.x);
  }
  // Nor is it missing ground.
  const auto missing = static_cast<std::uint8_t>(Label::kMissingGround);
  ASSERT_GT(labels.size(), 0U);
  EXPECT_EQ(std::count(labels.last()->data.begin(), labels.last()->data.end(), missing), 0);
  // There is floor beside the body, as near as that.
  EXPECT_LT(nearest, 0.75F);
}

TEST_F(Robot, ThePlaneTellsTfWhereTheCameraIs) {
  sendMount(cameraInBase());
  images_ = node_.advertise<sensor_msgs::Image>("/to_tf_depth/image_raw", 10);
  infos_ = node_.advertise<sensor_msgs::CameraInfo>("/to_tf_depth/camera_info", 10);
  Listener<DominantPlane> planes(node_, "/to_tf/plane");
  ASSERT_TRUE(ready(planes));
  // Above the optical frame there is base_link already: that is what found_base is above of.
  EXPECT_TRUE(sendUntil(planes, image_, [&](const DominantPlane&) {
    return buffer_.canTransform("found_base", "optical", ros::Time(0));
  }));
  const Eigen::Isometry3d camera =
      tf2::transformToEigen(buffer_.lookupTransform("found_base", "optical", ros::Time(0)));
  EXPECT_NEAR(camera.translation().z(), kHeight, 0.002);
  EXPECT_LT(camera.translation().head<2>().norm(), 0.002);
  EXPECT_LT((camera.linear() * kUp - Eigen::Vector3d::UnitZ()).norm(), 0.002);
  std::string parent;
  EXPECT_TRUE(buffer_._getParent("base_link", ros::Time(0), parent));
  EXPECT_EQ(parent, "found_base");
  EXPECT_TRUE(isFrom(*planes.last(), DominantPlane::UP_FIXED, kHeight) ||
              isFrom(*planes.last(), DominantPlane::UP_IMU, kHeight));
}

/// A recording that is played in a loop.
TEST_F(Robot, TimeThatGoesBackBeginsAnew) {
  sendMount(cameraInBase());
  Listener<DominantPlane> planes(node_, "/by_tf/plane");
  ASSERT_TRUE(ready(planes));
  ASSERT_TRUE(sendUntil(planes, image_, [](const DominantPlane& plane) {
    return isFrom(plane, DominantPlane::UP_TF, kHeight) && plane.tracked;
  }));
  answered_ = [&] { return planes.last()->header.stamp; };
  stamp_ -= ros::Duration(5.0);
  sendImages(image_, 1);
  EXPECT_EQ(planes.last()->header.stamp, stamp_);
  EXPECT_FALSE(planes.last()->tracked);
  EXPECT_TRUE(isFrom(*planes.last(), DominantPlane::UP_TF, kHeight));
  sendImages(image_, 1);
  EXPECT_TRUE(planes.last()->tracked);
}

/// What went out comes back: tf2 would warn of each transform that it knows. What somebody else
/// says of the same frame is heard.
TEST_F(Robot, OwnTransformsThatComeBackAreNoRepetition) {
  RobotFrames frames(node_);
  frames.listen();
  Listener<tf2_msgs::TFMessage> heard(node_, "/tf");
  const auto publisher = node_.advertise<tf2_msgs::TFMessage>("/tf", 10);
  ASSERT_TRUE(spinUntil([&] { return publisher.getNumSubscribers() > 1; }));
  const auto cameBack = [&](const ros::Time& stamp) {
    return std::any_of(heard.messages().begin(), heard.messages().end(), [&](const auto& message) {
      return message->transforms.at(0).child_frame_id == "own_ground" &&
             message->transforms[0].header.stamp == stamp;
    });
  };
  testing::internal::CaptureStderr();
  for (int i = 0; i < 20; ++i) {
    stamp_ += ros::Duration(1.0 / 30.0);
    frames.broadcast("optical", "own_ground", stamp_, Eigen::Isometry3d::Identity());
    EXPECT_TRUE(frames.pose("optical", "own_ground", stamp_).exact);
  }
  EXPECT_TRUE(spinUntil([&] { return cameBack(stamp_); }));
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(said.find("TF_REPEATED_DATA"), std::string::npos) << said;

  geometry_msgs::TransformStamped other = tf2::eigenToTransform(Eigen::Isometry3d::Identity());
  other.header.frame_id = "map";
  other.header.stamp = stamp_ + ros::Duration(1.0);
  other.child_frame_id = "own_ground";
  tf2_msgs::TFMessage message;
  message.transforms.push_back(other);
  publisher.publish(message);
  EXPECT_TRUE(spinUntil([&] { return frames.parentOf("own_ground") == "map"; }));
}

}  // namespace
}  // namespace dominant_plane_detection
