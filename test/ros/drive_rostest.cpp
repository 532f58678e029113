// The whole way, from the virtual sensor to plane and obstacles, against the scene's truth.

#include <dominant_plane_detection/DominantPlane.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/parameters.h"
#include "support/driver_test.h"
#include "support/ros_test.h"
#include "synthetic/scene.h"
#include "virtual_kinect/scene_camera.h"

namespace dominant_plane_detection {
namespace {

// Errors that average out, so that what the chain itself does wrong would show.
constexpr const char* kUri = "virtual://rubbish_bin?serial=DRIVE&sensor=independent";
// The bin of scenes/rubbish_bin.yaml.
const Eigen::Vector2d kBin(3.6, 0.05);  // [m]
constexpr double kBinRadius = 0.15;     // [m]
constexpr double kBinHeight = 0.4;      // [m]

/// What is true about a frame, and which of its pixels have to be in the obstacle cloud and which
/// must not.
struct Truth {
  Eigen::Vector3d normal;
  double distance = 0.0;
  std::vector<std::uint8_t> bin;    ///< 1: the bin, above the ground band
  std::vector<std::uint8_t> foot;   ///< 1: the bin within it, but three sigma(z) above the floor
  std::vector<std::uint8_t> floor;  ///< 1: the floor
};

class DriveTruth {
 public:
  DriveTruth()
      : scene_(loadScene(std::string(DPD_SOURCE) + "/scenes/rubbish_bin.yaml")),
        renderer_(scene_) {}

  Truth at(const virtual_kinect::FrameRecord& record, const sensor_msgs::Image& image) const {
    const Eigen::Isometry3d pose = scene_.path.at(record.scene_time).pose();
    const Rendering rendering = renderer_.render(pose, {});
    Truth truth{rendering.normal, rendering.distance, {}, {}, {}};
    truth.bin.resize(rendering.depth.size());
    truth.foot.resize(rendering.depth.size());
    truth.floor.resize(rendering.depth.size());
    const auto* readings = reinterpret_cast<const std::uint16_t*>(image.data.data());
    const Parameters parameters;
    for (std::size_t i = 0; i < rendering.depth.size(); ++i) {
      const double reading = 0.001 * readings[i];
      if (reading < 0.5 || reading > 4.0) continue;  // what the detection works on
      truth.floor[i] = rendering.labels[i] == static_cast<std::uint8_t>(Label::kGround) ? 1 : 0;
      const int u = static_cast<int>(i) % 640;
      const int v = static_cast<int>(i) / 640;
      const double z = static_cast<double>(rendering.depth[i]);
      const Eigen::Vector3d ray((u - scene_.camera.cx) / scene_.camera.fx,
                                (v - scene_.camera.cy) / scene_.camera.fy, 1.0);
      const Eigen::Vector3d point = pose * (z * ray);
      const bool of_bin = (point.head<2>() - kBin).norm() < kBinRadius + 0.002 && point.z() > 0.0 &&
                          point.z() < kBinHeight + 0.002;
      const double band = parameters.ground_band.at(z, parameters.noise);
      const bool above_band = point.z() > std::max(0.01, band);
      truth.bin[i] = of_bin && above_band ? 1 : 0;
      truth.foot[i] =
          of_bin && !above_band && point.z() > std::max(0.01, 3.0 * parameters.noise.sigma(z)) ? 1
                                                                                               : 0;
    }
    return truth;
  }
  /// @return the pixels of a cloud's points, by their rays.
  std::set<std::size_t> pixelsOf(const sensor_msgs::PointCloud2& cloud) const {
    std::set<std::size_t> pixels;
    sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x"), y(cloud, "y"), z(cloud, "z");
    for (; x != x.end(); ++x, ++y, ++z) {
      const double depth = static_cast<double>(*z);
      const long u =
          std::lround(scene_.camera.fx * static_cast<double>(*x) / depth + scene_.camera.cx);
      const long v =
          std::lround(scene_.camera.fy * static_cast<double>(*y) / depth + scene_.camera.cy);
      pixels.insert(static_cast<std::size_t>(640 * v + u));
    }
    return pixels;
  }
  double duration() const { return scene_.path.duration(); }

 private:
  Scene scene_;
  Renderer renderer_;
};

TEST(Drive, EveryFrameHasTheTruePlaneAndTheBin) {
  const DriveTruth drive;
  ros::NodeHandle node("/camera");
  Manager manager;
  Listener<DominantPlane> planes(node, "plane_detection/plane");
  Listener<sensor_msgs::PointCloud2> clouds(node, "plane_detection/obstacles");
  Listener<sensor_msgs::PointCloud2> grounds(node, "plane_detection/ground");
  // Kept until the end, so that every frame has a buffer of its own; its record is asked for before
  // it is forgotten.
  std::vector<sensor_msgs::ImageConstPtr> images;
  std::map<std::uint64_t, virtual_kinect::FrameRecord> records;
  const Probe probe(kUri);
  const ros::Subscriber subscriber = node.subscribe<sensor_msgs::Image>(
      "depth/image_raw", 1000, [&](const sensor_msgs::ImageConstPtr& image) {
        images.push_back(image);
        if (images.size() % 60 != 0) return;
        for (const auto& record : probe.records()) records[record.address] = record;
      });
  ASSERT_TRUE(manager.loadDriver("/camera", kUri));
  ASSERT_TRUE(manager.loadDetection("/camera"));
  const auto enough = static_cast<std::size_t>(30.0 * drive.duration());
  ASSERT_TRUE(spinUntil([&] { return planes.size() >= enough; }, 60.0));
  for (const auto& record : probe.records()) records[record.address] = record;
  ASSERT_TRUE(manager.unload("/camera/plane_detection"));
  ASSERT_TRUE(manager.unload("/camera/driver"));
  spinUntil([] { return false; }, 0.1);  // what is still on its way

  std::map<ros::Time, sensor_msgs::ImageConstPtr> image_of;
  for (const auto& image : images) image_of[image->header.stamp] = image;
  std::map<ros::Time, sensor_msgs::PointCloud2ConstPtr> cloud_of;
  for (const auto& cloud : clouds.messages()) cloud_of[cloud->header.stamp] = cloud;

  std::map<ros::Time, sensor_msgs::PointCloud2ConstPtr> ground_of;
  for (const auto& cloud : grounds.messages()) ground_of[cloud->header.stamp] = cloud;

  double worst_height = 0.0, worst_angle = 0.0, worst_bin = 1.0, worst_floor = 0.0;
  std::size_t foot = 0, foot_ground = 0;
  std::size_t compared = 0, with_bin = 0;
  for (const auto& plane : planes.messages()) {
    const auto image = image_of.find(plane->header.stamp);
    if (image == image_of.end()) continue;  // before the subscription
    const auto record = records.find(reinterpret_cast<std::uint64_t>(image->second->data.data()));
    ASSERT_NE(record, records.end());
    const Truth truth = drive.at(record->second, *image->second);
    ASSERT_EQ(plane->state, DominantPlane::FOUND) << plane->reason;
    const Eigen::Vector3d normal(plane->normal.x, plane->normal.y, plane->normal.z);
    worst_height = std::max(worst_height, std::abs(plane->distance - truth.distance));
    worst_angle = std::max(worst_angle, std::acos(std::min(normal.dot(truth.normal), 1.0)));
    ++compared;

    const auto cloud = cloud_of.find(plane->header.stamp);
    if (cloud == cloud_of.end()) continue;
    const std::set<std::size_t> obstacle = drive.pixelsOf(*cloud->second);
    std::size_t bin = 0, bin_found = 0, floor = 0, floor_wrong = 0;
    for (std::size_t i = 0; i < truth.bin.size(); ++i) {
      const bool listed = (truth.bin[i] != 0 || truth.floor[i] != 0) && obstacle.count(i) != 0;
      bin += truth.bin[i];
      bin_found += truth.bin[i] != 0 && listed ? 1 : 0;
      floor += truth.floor[i];
      floor_wrong += truth.floor[i] != 0 && listed ? 1 : 0;
    }
    const auto ground_cloud = ground_of.find(plane->header.stamp);
    if (ground_cloud != ground_of.end()) {
      const std::set<std::size_t> ground = drive.pixelsOf(*ground_cloud->second);
      for (std::size_t i = 0; i < truth.foot.size(); ++i) {
        foot += truth.foot[i];
        foot_ground += truth.foot[i] != 0 && ground.count(i) != 0 ? 1 : 0;
      }
    }
    if (bin > 0) {
      ++with_bin;
      worst_bin = std::min(worst_bin, static_cast<double>(bin_found) / static_cast<double>(bin));
    }
    worst_floor =
        std::max(worst_floor, static_cast<double>(floor_wrong) / static_cast<double>(floor));
  }
  std::cout << compared << " planes against the truth, worst: height " << 1e3 * worst_height
            << " mm, normal " << worst_angle * 180.0 / M_PI << " deg; obstacle cloud, worst of "
            << with_bin << ": " << 100.0 * worst_bin << " % of the bin, " << 100.0 * worst_floor
            << " % of the floor; ground cloud: " << foot_ground << " of " << foot
            << " pixels of the bin's foot\n";
  EXPECT_GE(compared, enough * 9 / 10);
  EXPECT_GE(with_bin, enough * 9 / 10);
  EXPECT_LT(worst_height, 0.003);
  EXPECT_LT(worst_angle, 0.2 * M_PI / 180.0);
  EXPECT_GE(worst_bin, 0.95);
  EXPECT_LE(worst_floor, 0.001);
  // The foot may be unknown, but is not for driving on.
  EXPECT_GT(foot, 1000U);
  EXPECT_LE(foot_ground, foot / 20);
}

}  // namespace
}  // namespace dominant_plane_detection
