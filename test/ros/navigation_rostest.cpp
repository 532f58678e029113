// The map, the boxes and the clouds that navigation takes, on scenes whose truth is known.

#include <dominant_plane_detection/ObstacleBoxArray.h>
#include <nav_msgs/OccupancyGrid.h>
#include <rosgraph_msgs/Log.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>

#include "costmap_contract.h"
#include "navigation/ground_sight.h"
#include "robot_fixture.h"

namespace dominant_plane_detection {
namespace {

const Eigen::Vector3d kBoxLow(1.3, -0.1, 0.0), kBoxHigh(1.5, 0.2, 0.2);  // [m] on the ground

/// The floor from a camera that looks down by 25 degrees, 0.6 m up.
GroundSight floorSight() { return {25.0 * kDegree, 0.05}; }
GroundSight boxSight() {
  GroundSight sight = floorSight();
  sight.addBox(kBoxLow, kBoxHigh);
  return sight;
}
sensor_msgs::Image imageOf(const GroundSight& sight) {
  return message(inMillimetres(sight.metres()));
}
/// @return T_base_optical: the base is 0.2 m behind the camera's foot, on the floor.
Eigen::Isometry3d mount() {
  Eigen::Isometry3d T_base_ground = Eigen::Isometry3d::Identity();
  T_base_ground.translation().x() = 0.2;
  return T_base_ground * groundFromOptical(upOf(25.0 * kDegree, 0.05), kSightHeight);
}
Eigen::Isometry3d odometry(double x, double y, double yaw) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  pose.translation() = Eigen::Vector3d(x, y, 0.0);
  return pose;
}

int stateAt(const nav_msgs::OccupancyGrid& map, const Eigen::Vector2d& place) {
  const auto cell = [&](double at, double origin) {
    return static_cast<std::size_t>((at - origin) / static_cast<double>(map.info.resolution));
  };
  return map.data.at(cell(place.y(), map.info.origin.position.y) * map.info.width +
                     cell(place.x(), map.info.origin.position.x));
}

class Navigation : public Robot {
 protected:
  Navigation() { sendMount(mount()); }

  /// Puts the robot somewhere, and waits until that is known here.
  bool drive(const Eigen::Isometry3d& pose) {
    sendFrame("odom", "base_link", pose);
    return spinUntil([&] {
      if (!buffer_.canTransform("odom", "base_link", ros::Time(0))) return false;
      const Eigen::Isometry3d known =
          tf2::transformToEigen(buffer_.lookupTransform("odom", "base_link", ros::Time(0)));
      return known.isApprox(pose, 1e-6);
    });
  }

  /// Sends an image until the node has answered with a map of it, and knows where the robot is.
  bool sendFrom(const Eigen::Isometry3d& base, const Listener<DominantPlane>& planes,
                const Listener<nav_msgs::OccupancyGrid>& maps, const sensor_msgs::Image& image) {
    const Eigen::Vector3d foot = base * Eigen::Vector3d(0.2, 0.0, 0.0);
    return sendUntil(planes, image, [&](const DominantPlane&) {
      if (maps.size() == 0 || maps.last()->header.stamp != stamp_) return false;
      const nav_msgs::MapMetaData& map = maps.last()->info;
      const double half = 0.5 * map.width * static_cast<double>(map.resolution);
      return std::hypot(map.origin.position.x + half - foot.x(),
                        map.origin.position.y + half - foot.y()) < 0.1;
    });
  }
  /// Sends an image until the node has answered with a map of it.
  template <typename Message>
  bool sendForLast(const Listener<DominantPlane>& planes, const Listener<Message>& results,
                   const sensor_msgs::Image& image) {
    return sendUntil(planes, image, [&](const DominantPlane&) {
      return results.size() > 0 && results.last()->header.stamp == stamp_;
    });
  }
};

/// Of one image, in the frame on the ground, whose tf goes out with it.
TEST_F(Navigation, WithoutOdometryAMapIsOfOneImage) {
  Listener<DominantPlane> planes(node_, "/on_ground/plane");
  Listener<nav_msgs::OccupancyGrid> maps(node_, "/on_ground/local_map");
  ASSERT_TRUE(ready(planes, maps));
  // The first transforms may come before anybody hears them.
  ASSERT_TRUE(sendUntil(planes, imageOf(boxSight()), [&](const DominantPlane&) {
    return maps.size() > 0 && maps.last()->header.stamp == stamp_ &&
           buffer_.canTransform("ground_of_map", "optical", stamp_);
  }));
  const nav_msgs::OccupancyGrid map = *maps.last();
  EXPECT_EQ(map.header.frame_id, "ground_of_map");
  EXPECT_EQ(map.info.width, 160U);
  EXPECT_EQ(map.info.height, 160U);
  EXPECT_FLOAT_EQ(map.info.resolution, 0.05F);
  EXPECT_NEAR(map.info.origin.position.x, -4.0, 0.051);
  EXPECT_NEAR(map.info.origin.position.y, -4.0, 0.051);
  EXPECT_EQ(map.info.origin.orientation.w, 1.0);
  for (double y = -0.08; y < 0.2; y += 0.05) EXPECT_EQ(stateAt(map, {1.32, y}), 100) << y;
  for (double x = 0.95; x < 1.25; x += 0.05) EXPECT_EQ(stateAt(map, {x, 0.0}), 0) << x;
  for (double x = 1.0; x < 2.2; x += 0.05) EXPECT_EQ(stateAt(map, {x, -0.4}), 0) << x;
  EXPECT_EQ(stateAt(map, {1.9, 0.05}), -1);  // hidden
  EXPECT_EQ(stateAt(map, {0.3, 0.0}), -1);   // below the camera
  EXPECT_EQ(stateAt(map, {-1.0, 0.0}), -1);
  // The next image is another map.
  ASSERT_TRUE(sendForLast(planes, maps, imageOf(floorSight())));
  EXPECT_EQ(stateAt(*maps.last(), {1.32, 0.0}), 0);
}

TEST_F(Navigation, WithOdometryTheMapKeepsWhatWasSeen) {
  Listener<DominantPlane> planes(node_, "/in_odom/plane");
  Listener<nav_msgs::OccupancyGrid> maps(node_, "/in_odom/local_map");
  Listener<rosgraph_msgs::Log> logs(node_, "/rosout");
  ASSERT_TRUE(ready(planes, maps));
  // Without tf there is no map, and the log says why.
  const auto said = [&] {
    return std::any_of(logs.messages().begin(), logs.messages().end(), [](const auto& line) {
      return line->msg.find("Nothing is added to the map in odom") != std::string::npos;
    });
  };
  EXPECT_TRUE(sendUntil(planes, imageOf(boxSight()), [&](const DominantPlane&) { return said(); }));
  EXPECT_EQ(maps.size(), 0U);

  const Eigen::Isometry3d begin = odometry(10.0, -3.0, 0.7);
  ASSERT_TRUE(drive(begin));
  ASSERT_TRUE(sendFrom(begin, planes, maps, imageOf(boxSight())));
  // More than once: an image of the floor may be looked at before the robot is known to have moved.
  sendImages(imageOf(boxSight()), 5);
  ASSERT_TRUE(sendForLast(planes, maps, imageOf(boxSight())));
  EXPECT_EQ(maps.last()->header.frame_id, "odom");
  EXPECT_EQ(maps.last()->info.width, 120U);
  EXPECT_NEAR(maps.last()->info.origin.position.z, 0.0, 0.01);
  const auto inOdom = [](const Eigen::Isometry3d& base, double x, double y) {
    return Eigen::Vector2d((base * Eigen::Vector3d(x + 0.2, y, 0.0)).head<2>());
  };
  EXPECT_EQ(stateAt(*maps.last(), inOdom(begin, 1.32, 0.0)), 100);
  EXPECT_EQ(stateAt(*maps.last(), inOdom(begin, 1.0, 0.0)), 0);

  // It drives past the box: both it and the floor that was seen are behind, and where they were.
  const Eigen::Isometry3d end = odometry(11.5, -2.0, 2.2);
  ASSERT_TRUE(drive(end));
  ASSERT_TRUE(sendFrom(end, planes, maps, imageOf(floorSight())));
  EXPECT_EQ(stateAt(*maps.last(), inOdom(begin, 1.32, 0.0)), 100);
  EXPECT_EQ(stateAt(*maps.last(), inOdom(begin, 1.0, 0.0)), 0);
  EXPECT_EQ(stateAt(*maps.last(), inOdom(end, 1.32, 0.0)), 0);

  // Without a plane what is known still goes out.
  const std::size_t before = maps.size();
  sensor_msgs::Image empty = imageOf(floorSight());
  std::fill(empty.data.begin(), empty.data.end(), 0);
  ASSERT_TRUE(sendUntil(planes, empty, [&](const DominantPlane& plane) {
    return plane.state != DominantPlane::FOUND && maps.size() > before &&
           maps.last()->header.stamp == plane.header.stamp;
  }));
  EXPECT_EQ(stateAt(*maps.last(), inOdom(begin, 1.32, 0.0)), 100);
}

/// A robot that stands before a wall for longer than its map remembers.
TEST_F(Navigation, WithoutPlanesTheMapFadesAndGoesOn) {
  const Eigen::Isometry3d origin = odometry(0.0, 0.0, 0.0);
  ASSERT_TRUE(drive(origin));
  Listener<DominantPlane> planes(node_, "/forgetful/plane");
  Listener<nav_msgs::OccupancyGrid> maps(node_, "/forgetful/local_map");
  ASSERT_TRUE(ready(planes, maps));
  ASSERT_TRUE(sendFrom(origin, planes, maps, imageOf(boxSight())));
  sendImages(imageOf(boxSight()), 10);
  ASSERT_TRUE(sendForLast(planes, maps, imageOf(boxSight())));
  EXPECT_EQ(maps.last()->header.frame_id, "odom");
  EXPECT_EQ(stateAt(*maps.last(), {1.52, 0.0}), 100);
  EXPECT_EQ(stateAt(*maps.last(), {1.2, 0.0}), 0);
  sensor_msgs::Image empty = imageOf(floorSight());
  std::fill(empty.data.begin(), empty.data.end(), 0);
  sendImages(empty, 25);
  ASSERT_TRUE(sendForLast(planes, maps, empty));
  EXPECT_EQ(stateAt(*maps.last(), {1.52, 0.0}), 100);
  sendImages(empty, 80);
  ASSERT_TRUE(sendForLast(planes, maps, empty));
  EXPECT_EQ(stateAt(*maps.last(), {1.52, 0.0}), -1);
  EXPECT_EQ(stateAt(*maps.last(), {1.2, 0.0}), -1);
}

TEST_F(Navigation, AMapThatIsTooLargeIsRefused) {
  Listener<DominantPlane> planes(node_, "/too_large/plane");
  Listener<nav_msgs::OccupancyGrid> maps(node_, "/too_large/local_map");
  ASSERT_TRUE(ready(planes, maps));
  ASSERT_TRUE(sendForLast(planes, maps, imageOf(floorSight())));
  EXPECT_EQ(maps.last()->info.width, 160U);
}

TEST_F(Navigation, ThingsAreBoxesThatKeepTheirNumbers) {
  ASSERT_TRUE(drive(odometry(0.0, 0.0, 0.0)));
  Listener<DominantPlane> planes(node_, "/in_odom/plane");
  Listener<ObstacleBoxArray> boxes(node_, "/in_odom/obstacle_boxes");
  Listener<visualization_msgs::MarkerArray> markers(node_, "/in_odom/obstacle_box_markers");
  ASSERT_TRUE(ready(planes, boxes, markers));
  // In the third image that has it.
  ASSERT_TRUE(sendUntil(planes, imageOf(boxSight()), [&](const DominantPlane&) {
    return boxes.size() > 0 && boxes.last()->header.stamp == stamp_ &&
           boxes.last()->boxes.size() == 1;
  }));
  EXPECT_GE(boxes.last()->boxes[0].images, 3U);
  const ObstacleBox box = boxes.last()->boxes[0];
  EXPECT_EQ(boxes.last()->header.frame_id, "optical");
  Eigen::Isometry3d pose;
  tf2::fromMsg(box.pose, pose);
  const Eigen::Isometry3d T_ground_optical =
      groundFromOptical(upOf(25.0 * kDegree, 0.05), kSightHeight);
  EXPECT_LT((T_ground_optical * pose.translation() - 0.5 * (kBoxLow + kBoxHigh)).norm(), 0.02);
  EXPECT_LT((T_ground_optical.linear() * pose.linear().col(2) - Eigen::Vector3d::UnitZ()).norm(),
            0.01);
  EXPECT_NEAR(box.size.x, 0.3, 0.02);
  EXPECT_NEAR(box.size.y, 0.2, 0.02);
  EXPECT_NEAR(box.size.z, 0.2, 0.01);
  EXPECT_NEAR(static_cast<double>(box.height), 0.2, 0.01);
  EXPECT_NEAR(static_cast<double>(box.distance), 1.3, 0.02);
  EXPECT_GT(box.pixels, 1000U);
  ASSERT_TRUE(spinUntil([&] { return markers.size() > 0 && !markers.last()->markers.empty(); }));
  const visualization_msgs::Marker& cube = markers.last()->markers.at(0);
  EXPECT_EQ(cube.type, visualization_msgs::Marker::CUBE);
  EXPECT_NEAR(cube.scale.x, box.size.x, 0.01);
  EXPECT_EQ(cube.id, static_cast<int>(box.id));

  // Seen from elsewhere it is the same thing: the robot drove 0.4 m and turned by 20 degrees.
  const Eigen::Isometry3d moved = odometry(0.4, 0.1, 20.0 * kDegree);
  ASSERT_TRUE(drive(moved));
  GroundSight sight = floorSight();
  const Eigen::Vector3d in_base(0.2, 0.0, 0.0);
  const Eigen::Vector3d centre = moved.inverse() * (0.5 * (kBoxLow + kBoxHigh) + in_base) - in_base;
  sight.addBox(centre - Eigen::Vector3d(0.1, 0.1, 0.1), centre + Eigen::Vector3d(0.1, 0.1, 0.1));
  // And another one came.
  sight.addBox({2.0, -0.6, 0.0}, {2.2, -0.3, 0.3});
  ASSERT_TRUE(sendUntil(planes, imageOf(sight), [&](const DominantPlane&) {
    return boxes.last()->header.stamp == stamp_ && boxes.last()->boxes.size() == 2;
  }));
  EXPECT_EQ(boxes.last()->boxes[0].id, box.id);
  EXPECT_GT(boxes.last()->boxes[0].images, box.images);
  EXPECT_NE(boxes.last()->boxes[1].id, box.id);
}

/// A pose of a thirtieth of a second ago would put what is seen where it is not.
TEST_F(Navigation, PosesOfAnotherTimeAddNothingToTheMap) {
  tf2_ros::TransformBroadcaster broadcaster;
  Listener<DominantPlane> planes(node_, "/slow_odometry/plane");
  Listener<nav_msgs::OccupancyGrid> maps(node_, "/slow_odometry/local_map");
  ASSERT_TRUE(ready(planes, maps));
  const auto sendOdometry = [&](const ros::Time& stamp) {
    geometry_msgs::TransformStamped pose = tf2::eigenToTransform(Eigen::Isometry3d::Identity());
    pose.header.frame_id = "base_link";
    pose.header.stamp = stamp;
    pose.child_frame_id = "slow_odom";
    broadcaster.sendTransform(pose);
    return spinUntil([&] { return buffer_.canTransform("slow_odom", "optical", stamp); });
  };
  const sensor_msgs::Image image = imageOf(boxSight());
  int late = 0;
  EXPECT_TRUE(sendUntil(planes, image, [&](const DominantPlane&) {
    EXPECT_TRUE(sendOdometry(stamp_));  // of the image before the next
    return ++late >= 20;
  }));
  EXPECT_EQ(maps.size(), 0U);
  EXPECT_TRUE(sendUntil(planes, image, [&](const DominantPlane&) {
    EXPECT_TRUE(sendOdometry(stamp_ + ros::Duration(1.0 / 30.0)));
    return maps.size() > 0 && stateAt(*maps.last(), {1.52, 0.0}) == 100;
  }));
}

/// Odometry at 10 Hz has nothing for every third image of 30 Hz.
TEST_F(Navigation, SlowOdometryKeepsNumbersToo) {
  tf2_ros::TransformBroadcaster broadcaster;
  Listener<DominantPlane> planes(node_, "/slow_odometry/plane");
  Listener<ObstacleBoxArray> boxes(node_, "/slow_odometry/obstacle_boxes");
  ASSERT_TRUE(ready(planes, boxes));
  const sensor_msgs::Image image = imageOf(boxSight());
  geometry_msgs::TransformStamped odometry = tf2::eigenToTransform(Eigen::Isometry3d::Identity());
  odometry.header.frame_id = "base_link";
  odometry.child_frame_id = "slow_odom";
  int images = 0;
  const auto sendOdometry = [&] {
    if (images++ % 3 != 0) return;
    odometry.header.stamp = stamp_ + ros::Duration(1.0 / 30.0);
    broadcaster.sendTransform(odometry);
    spinUntil([&] { return buffer_.canTransform("slow_odom", "optical", odometry.header.stamp); });
  };
  sendOdometry();
  ASSERT_TRUE(sendUntil(planes, image, [&](const DominantPlane&) {
    sendOdometry();
    return boxes.size() > 0 && !boxes.last()->boxes.empty();
  }));
  // At the start odometry is not there yet, and what is followed without it is not the same.
  std::uint32_t id = 0;
  int same = 0;
  EXPECT_TRUE(sendUntil(planes, image,
                        [&](const DominantPlane&) {
                          sendOdometry();
                          const auto& last = boxes.last()->boxes;
                          same = last.size() == 1 && last[0].id == id ? same + 1 : 0;
                          id = last.size() == 1 ? last[0].id : 0;
                          return same >= 60;
                        }))
      << "the same thing in " << same << " images";
}

/// The recipe of docs/robot.md: what it says is what costmap_2d needs.
TEST_F(Navigation, TheRecipeForCostmapsMarksObstaclesAndClearsGround) {
  const Eigen::Isometry3d begin = odometry(2.0, 1.0, 0.5);
  ASSERT_TRUE(drive(begin));
  CostmapContract costmap(node_, buffer_, "odom", "/in_odom");
  Listener<DominantPlane> planes(node_, "/in_odom/plane");
  ASSERT_TRUE(ready(planes));
  ASSERT_TRUE(spinUntil([&] { return costmap.connected(); }));
  const auto at = [](const Eigen::Isometry3d& base, double x, double y) {
    return Eigen::Vector3d(base * Eigen::Vector3d(x + 0.2, y, 0.0));
  };
  GroundSight low_box = floorSight();
  low_box.addBox({1.0, -0.1, 0.0}, {1.2, 0.1, 0.08});
  ASSERT_TRUE(sendUntil(planes, imageOf(low_box),
                        [&](const DominantPlane&) { return costmap.update(stamp_); }));
  EXPECT_EQ(costmap.at(at(begin, 1.02, 0.0)), CostmapContract::kLethal);
  EXPECT_EQ(costmap.at(at(begin, 1.5, -0.4)), CostmapContract::kFree);
  EXPECT_EQ(costmap.at(at(begin, 1.9, 0.0)), CostmapContract::kFree);
  EXPECT_EQ(costmap.at(at(begin, -1.0, 0.0)), CostmapContract::kUnknown);
  EXPECT_EQ(costmap.lethalCells({at(begin, 0.9, -0.25), at(begin, 1.35, 0.25)}),
            costmap.lethalCells());

  // Nearer than the camera sees, the box stays, though rays to the floor pass over it.
  const Eigen::Isometry3d near = begin * odometry(0.75, 0.0, 0.0);
  ASSERT_TRUE(drive(near));
  ASSERT_TRUE(sendUntil(planes, imageOf(floorSight()),
                        [&](const DominantPlane&) { return costmap.update(stamp_); }));
  EXPECT_EQ(costmap.at(at(begin, 1.02, 0.0)), CostmapContract::kLethal);
  EXPECT_EQ(costmap.at(at(near, 1.9, 0.0)), CostmapContract::kFree);

  // And where it is seen to have gone it is cleared.
  ASSERT_TRUE(drive(begin));
  ASSERT_TRUE(sendUntil(planes, imageOf(floorSight()),
                        [&](const DominantPlane&) { return costmap.update(stamp_); }));
  EXPECT_EQ(costmap.lethalCells(), 0);
}

}  // namespace
}  // namespace dominant_plane_detection
