// The doctor on a running system: what is wrong with each of its detections.

#include <dominant_plane_detection/DominantPlane.h>
#include <pcl_conversions/pcl_conversions.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/transform_broadcaster.h>

#include <cstring>

#include "core/ray_table.h"
#include "doctor_fixture.h"
#include "support/diagnostics.h"

namespace dominant_plane_detection {
namespace {

using Words = std::vector<const char*>;

/// The cameras of doctor.test's detections.
class DoctorLive : public testing::Test {
 protected:
  DoctorLive() {
    for (const char* name :
         {"healthy", "rectified", "mounted", "no_camera_info", "camera_info_size", "uncalibrated",
          "stamps_apart", "topics_swapped", "encoding", "mirrored", "depth_scale", "range_max",
          "upside_down", "no_tf", "tf_disagrees", "stamps_off_clock", "late_tf", "transport",
          "slow"}) {
      const std::string begin = "/" + std::string(name) + "/depth/";
      images_[name] = node_.advertise<sensor_msgs::Image>(begin + "image_raw", 2);
      if (std::string(name) == "no_camera_info") continue;
      infos_[name] = node_.advertise<sensor_msgs::CameraInfo>(begin + "camera_info", 2);
    }
    clouds_ = node_.advertise<sensor_msgs::PointCloud2>("/clouds/depth/points", 2);
    makeCloud();
  }

  void makeCloud() {
    RayTable rays;
    rays.build(bin_.camera);
    pcl::PointCloud<pcl::PointXYZ> points(bin_.image.width, bin_.image.height);
    for (std::size_t i = 0; i < bin_.pixels.size(); ++i) {
      const auto u = static_cast<int>(i % bin_.image.width);
      const auto v = static_cast<int>(i / bin_.image.width);
      const float z = 0.001F * static_cast<float>(bin_.pixels[i]);
      const Eigen::Vector3f point = (z > 0.0F ? z : NAN) * rays.ray(u, v);
      points[i] = {point.x(), point.y(), point.z()};
    }
    pcl::toROSMsg(points, cloud_);
  }

  /// An image of each camera.
  void publish() {
    const ros::Time now = ros::Time::now();
    publishLateTf(now);
    for (auto& [name, publisher] : images_) {
      if (name == "slow") continue;
      sensor_msgs::Image image = bin_.image;
      sensor_msgs::CameraInfo info = bin_.info;
      image.header.stamp = info.header.stamp = now;
      image.header.frame_id = info.header.frame_id = name + "_optical";
      plant(name, image, info);
      if (infos_.count(name) != 0) infos_[name].publish(info);
      publisher.publish(image);
    }
    cloud_.header.stamp = now;
    cloud_.header.frame_id = "clouds_optical";
    clouds_.publish(cloud_);
  }

  /// As of a joint whose state comes a third of a second after the image.
  void publishLateTf(const ros::Time& now) {
    geometry_msgs::TransformStamped late;
    late.header.frame_id = "late_base";
    late.header.stamp = now - ros::Duration(0.3);
    late.child_frame_id = "late_tf_optical";
    late.transform.rotation.w = 1.0;
    transforms_.sendTransform(late);
  }

  void plant(const std::string& name, sensor_msgs::Image& image,
             sensor_msgs::CameraInfo& info) const {
    if (name == "rectified") info.K.fill(0.0);
    if (name == "camera_info_size") info.width = 320;
    if (name == "uncalibrated") info.K.fill(0.0);
    if (name == "stamps_apart") info.header.stamp += ros::Duration(0.004);
    if (name == "encoding") image.encoding = "bayer_rggb8";
    if (name == "stamps_off_clock") {
      image.header.stamp -= ros::Duration(100.0);
      info.header.stamp = image.header.stamp;
    }
    if (name != "mirrored" && name != "depth_scale") return;
    std::vector<std::uint16_t> pixels = bin_.pixels;
    for (std::uint32_t v = 0; name == "mirrored" && v < image.height; ++v) {
      std::reverse(&pixels[v * image.width], &pixels[v * image.width] + image.width);
    }
    for (std::uint16_t& z : pixels) {
      if (name == "depth_scale") z = static_cast<std::uint16_t>(std::min(65535, 10 * z));
    }
    std::memcpy(image.data.data(), pixels.data(), image.data.size());
  }

  ros::NodeHandle node_;
  BinCamera bin_;
  sensor_msgs::PointCloud2 cloud_;
  std::map<std::string, ros::Publisher> images_;
  std::map<std::string, ros::Publisher> infos_;
  ros::Publisher clouds_;
  tf2_ros::TransformBroadcaster transforms_;
};

void expectOnly(const Outcome& outcome, const std::string& node, const std::string& code,
                const Words& words) {
  const auto lines = linesOf(outcome, "/" + node + "/detection");
  ASSERT_EQ(lines.size(), 1U) << node << " in\n" << outcome.text;
  EXPECT_EQ(lines.front().rfind(code + ": ", 0), 0U) << lines.front();
  for (const char* word : words) {
    EXPECT_NE(lines.front().find(word), std::string::npos) << word << " in " << lines.front();
  }
}

TEST_F(DoctorLive, FindsWhatIsWrongWithEachDetectionAndNoMore) {
  Diagnostics diagnostics(node_);
  const auto runs = [&](const std::string& name) {
    return diagnostics.of(name + "/detection: detection").has_value();
  };
  ASSERT_TRUE(spinUntil([&] {
    return runs("clouds") && runs("no_images") &&
           std::all_of(images_.begin(), images_.end(),
                       [&](const auto& image) { return runs(image.first); });
  })) << "they are loaded in any order";
  const Outcome outcome = runDoctor(duration(10.0), [&] { publish(); });
  EXPECT_EQ(outcome.status, 1) << outcome.text;
  for (const char* node : {"healthy", "rectified", "clouds", "mounted"}) {
    EXPECT_TRUE(linesOf(outcome, "/" + std::string(node) + "/detection").empty()) << outcome.text;
  }
  expectOnly(outcome, "no_images", "no-images", {"nobody publishes", "depth/image_raw:="});
  expectOnly(outcome, "no_camera_info", "no-camera-info", {"/no_camera_info/depth/camera_info"});
  expectOnly(outcome, "camera_info_size", "camera-info-size", {"640 x 480", "320 x 480"});
  expectOnly(outcome, "uncalibrated", "uncalibrated", {"in K", "depth_camera_info_url"});
  expectOnly(outcome, "stamps_apart", "stamps-apart", {"header.stamp"});
  expectOnly(outcome, "topics_swapped", "topics-swapped",
             {"/topics_swapped/depth/image_raw", "input to depth"});
  expectOnly(outcome, "encoding", "encoding", {"got 'bayer_rggb8'"});
  expectOnly(outcome, "mirrored", "mirrored", {"mirroring off"});
  expectOnly(outcome, "depth_scale", "depth-scale", {"Multiplied by 0.1", "z_scale"});
  expectOnly(outcome, "range_max", "range-max", {"Set range_max to 1"});
  expectOnly(outcome, "upside_down", "upside-down", {"expected_up_y"});
  expectOnly(outcome, "no_tf", "no-tf", {"no_such_base", "base_frame"});
  expectOnly(outcome, "tf_disagrees", "tf-disagrees", {"calibrate_mount", "mount_height"});
  expectOnly(outcome, "late_tf", "no-tf", {"late_base", "too late or too seldom"});
  expectOnly(outcome, "transport", "unusable-images",
             {"cannot be subscribed", "no_such_transport", "parameter image_transport"});
  expectOnly(outcome, "stamps_off_clock", "stamps-off-clock", {"100.", "time_offset"});
}

TEST_F(DoctorLive, LooksAtOneOfThemOrAtATopic) {
  Outcome outcome = runDoctor("--node healthy/detection " + duration(2.0), [&] { publish(); });
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(outcome.text.rfind("healthy: ", 0), 0U) << outcome.text;
  EXPECT_NE(outcome.text.find("/healthy/depth/image_raw"), std::string::npos) << outcome.text;
  // A dozen images, at the least, have shadows enough.
  outcome = runDoctor("--topic /mirrored/depth/image_raw --set range_max=0.7 " + duration(8.0),
                      [&] { publish(); });
  EXPECT_EQ(outcome.status, 1) << outcome.text;
  EXPECT_EQ(outcome.text.rfind("range-max: ", 0), 0U) << outcome.text;
  EXPECT_NE(outcome.text.find("\nmirrored: "), std::string::npos) << outcome.text;
  outcome = runDoctor("--node healthy/detection --set range_max=0.7 " + duration(2.0),
                      [&] { publish(); });
  EXPECT_EQ(outcome.status, 1) << outcome.text;
  EXPECT_EQ(outcome.text.rfind("range-max: ", 0), 0U) << "what is set overrides: " << outcome.text;
  // The input is well by another transport, but the detection does not take it.
  outcome = runDoctor("--node transport/detection --set image_transport=raw " + duration(4.0),
                      [&] { publish(); });
  EXPECT_EQ(outcome.status, 1) << outcome.text;
  EXPECT_EQ(outcome.text.rfind("unusable-images: ", 0), 0U) << outcome.text;
  EXPECT_NE(outcome.text.find("cannot subscribe"), std::string::npos) << outcome.text;
  outcome = runDoctor("--node no_such_node", [&] { publish(); });
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.text.find("/healthy/detection"), std::string::npos) << outcome.text;
}

/// The same rules, in the nodelet's own words.
TEST_F(DoctorLive, DiagnosticsNameTheCause) {
  using diagnostic_msgs::DiagnosticStatus;
  Diagnostics diagnostics(node_);
  Listener<DominantPlane> upside_down(node_, "/upside_down/detection/plane");
  Listener<DominantPlane> encoding(node_, "/encoding/detection/plane");
  Listener<DominantPlane> healthy(node_, "/healthy/detection/plane");
  const auto says = [&](const char* name, int level, const char* text) {
    return spinUntil([&] {
      publish();
      return diagnostics.waitFor(std::string(name) + "/detection: detection", level, text, 0.2);
    });
  };
  EXPECT_TRUE(says("upside_down", DiagnosticStatus::WARN, "change the sign of expected_up_y"))
      << diagnostics.message("upside_down/detection: detection");
  EXPECT_EQ(diagnostics.value("upside_down/detection: detection", "likeliest cause")
                .rfind("upside-down: ", 0),
            0U);
  EXPECT_TRUE(says("encoding", DiagnosticStatus::WARN, "no depth in millimetres"))
      << diagnostics.message("encoding/detection: detection");
  EXPECT_EQ(
      diagnostics.value("encoding/detection: detection", "likeliest cause").rfind("encoding: ", 0),
      0U);
  EXPECT_TRUE(says("healthy", DiagnosticStatus::OK, "a plane in"));
  EXPECT_EQ(diagnostics.value("healthy/detection: detection", "likeliest cause"), "");
  EXPECT_EQ(diagnostics.value("healthy/detection: detection", "topic of depth images"),
            "/healthy/depth/image_raw");
}

TEST_F(DoctorLive, DiagnosticsNameTheCauseBeforeSlowness) {
  Diagnostics diagnostics(node_);
  Listener<DominantPlane> slow(node_, "/slow/detection/plane");
  const auto publishFast = [&] {
    bin_.image.header.stamp = bin_.info.header.stamp = ros::Time::now();
    bin_.image.header.frame_id = bin_.info.header.frame_id = "slow_optical";
    infos_["slow"].publish(bin_.info);
    images_["slow"].publish(bin_.image);
  };
  EXPECT_TRUE(spinUntil(
      [&] {
        publishFast();
        return diagnostics.waitFor("slow/detection: detection",
                                   diagnostic_msgs::DiagnosticStatus::WARN,
                                   "change the sign of expected_up_y", 0.02);
      },
      40.0))
      << diagnostics.message("slow/detection: detection");
}

}  // namespace
}  // namespace dominant_plane_detection
