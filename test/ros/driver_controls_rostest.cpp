// What users set of a camera while it runs, by the driver nodelet with a virtual Kinect.

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/Float64.h>
#include <std_msgs/UInt16.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/diagnostics.h"
#include "support/driver_test.h"
#include "support/log_lines.h"
#include "support/reconfigure.h"
#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDriver = "/camera/driver";

/// In a scene in which nothing moves, so that images are the same but for what was set.
class DriverControls : public testing::Test {
 protected:
  using Images = Listener<sensor_msgs::Image>;

  static std::string still(const std::string& serial) {
    return std::string("virtual://") + DPD_SOURCE +
           "/test/ros/still_scene.yaml?noise=0&serial=" + serial;
  }

  /// @return whether the images to come soon are as bright as `factor` times another one is.
  static bool becomes(const Images& images, const sensor_msgs::Image& image, double factor) {
    return spinUntil([&] {
      const auto& now = images.last()->data;
      return std::equal(now.begin(), now.end(), image.data.begin(), image.data.end(),
                        [&](std::uint8_t bright, std::uint8_t before) {
                          return bright == std::lround(std::min(factor * before, 255.0));
                        });
    });
  }

  ros::NodeHandle node_{"/camera"};
  Manager manager_;
};

TEST_F(DriverControls, ExposureAndGainHoldWhileTheCameraDoesNotChooseThem) {
  ASSERT_TRUE(manager_.loadDriver("/camera", still("E1"), {{"exposure", "10000"}}));
  Images images(node_, "rgb/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 10; }));
  const auto automatic = images.last();
  EXPECT_GT(*std::max_element(automatic->data.begin(), automatic->data.end()), 100);
  EXPECT_EQ(images.messages().front()->data, automatic->data) << "auto_exposure is on";
  // What was set before holds as soon as the camera does not choose itself.
  EXPECT_FALSE(change(kDriver, "auto_exposure", false));
  EXPECT_TRUE(becomes(images, *automatic, 10000.0 / virtual_kinect::kAutomaticExposure));
  EXPECT_EQ(change(kDriver, "exposure", 30000), 30000);
  EXPECT_TRUE(becomes(images, *automatic, 30000.0 / virtual_kinect::kAutomaticExposure));
  EXPECT_EQ(change(kDriver, "gain", 40), 40);
  EXPECT_TRUE(becomes(images, *automatic, 0.4 * 30000.0 / virtual_kinect::kAutomaticExposure));
  // 0 leaves it as it is.
  EXPECT_EQ(change(kDriver, "exposure", 0), 0);
  EXPECT_TRUE(becomes(images, *automatic, 0.4 * 30000.0 / virtual_kinect::kAutomaticExposure));
  EXPECT_TRUE(change(kDriver, "auto_exposure", true));
  EXPECT_TRUE(becomes(images, *automatic, 1.0));
}

/// The virtual Kinect has forgotten it whenever its stream starts.
TEST_F(DriverControls, AnExposureHoldsThoughTheCameraForgetsIt) {
  ASSERT_TRUE(manager_.loadDriver("/camera", still("E2")));
  sensor_msgs::ImageConstPtr automatic;
  {
    Images images(node_, "rgb/image_raw");
    ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
    automatic = images.last();
  }
  EXPECT_FALSE(change(kDriver, "auto_exposure", false));
  EXPECT_EQ(change(kDriver, "exposure", 10000), 10000);
  EXPECT_EQ(change(kDriver, "gain", 50), 50);
  Images images(node_, "rgb/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 1; }));
  EXPECT_TRUE(becomes(images, *automatic, 0.25));
}

/// @return what the message of a topic's type holds.
template <typename Message, typename Value>
Message holding(Value value) {
  Message message;
  message.data = value;
  return message;
}

TEST_F(DriverControls, TheMotorTurnsTheCameraAndTellsItsAngle) {
  const std::string uri = still("M1");
  ASSERT_TRUE(manager_.loadDriver("/camera", uri));
  ros::Publisher tilt = node_.advertise<std_msgs::Float64>("tilt_angle", 1);
  Listener<std_msgs::Float64> angles(node_, "cur_tilt_angle");
  Listener<sensor_msgs::Imu> readings(node_, "imu/data_raw");
  ASSERT_TRUE(spinUntil(
      [&] { return angles.size() >= 3 && readings.size() >= 3 && tilt.getNumSubscribers() > 0; }));
  EXPECT_EQ(angles.last()->data, 0.0);
  const auto down = [&] {
    const auto& a = readings.last()->linear_acceleration;
    return std::atan2(a.z, -a.y);
  };
  // The scene's camera looks down by 0.1 rad, so that up is behind it.
  EXPECT_NEAR(down(), -0.1, 1e-9);
  tilt.publish(holding<std_msgs::Float64>(0.3));
  EXPECT_TRUE(spinUntil([&] { return angles.last()->data == 0.3; }));
  EXPECT_TRUE(spinUntil([&] { return std::abs(down() - 0.2) < 1e-9; })) << down();
  tilt.publish(holding<std_msgs::Float64>(-0.54));
  EXPECT_TRUE(spinUntil([&] { return angles.last()->data == -0.54; }));

  LogLines log;
  // Said once a second at most.
  const std::pair<double, const char*> refused[] = {
      {0.55, "expected -0.54 to 0.54 rad, got 0.55. Were degrees meant?"},
      {20.0, "got 20. Were degrees meant? That would be 0.349066 rad"},
      {std::nan(""), "got nan"}};
  for (const auto& [angle, text] : refused) {
    EXPECT_TRUE(spinUntil([&, angle = angle, text = text] {
      tilt.publish(holding<std_msgs::Float64>(angle));
      return log.count(text) > 0;
    })) << text;
  }
  const std::size_t more = angles.size() + 3;
  ASSERT_TRUE(spinUntil([&] { return angles.size() >= more; }));
  EXPECT_EQ(angles.last()->data, -0.54);
}

/// Listening to it alone starts the depth stream.
TEST_F(DriverControls, TheProjectorIsTheSecondCameraOfAStereoPair) {
  ASSERT_TRUE(manager_.loadDriver("/camera", still("P1"), {{"depth_frame_id", "d"}}));
  Listener<sensor_msgs::CameraInfo> projector(node_, "projector/camera_info");
  ASSERT_TRUE(spinUntil([&] { return projector.size() >= 3; }));
  Images images(node_, "depth/image_raw");
  Listener<sensor_msgs::CameraInfo> infos(node_, "depth/camera_info");
  const auto both = [&]() -> sensor_msgs::CameraInfoConstPtr {
    for (const auto& info : infos.messages()) {
      if (info->header.stamp == projector.last()->header.stamp) return info;
    }
    return nullptr;
  };
  ASSERT_TRUE(spinUntil([&] { return both() != nullptr; })) << "of one stamp";
  const sensor_msgs::CameraInfo& right = *projector.last();
  sensor_msgs::CameraInfo left = *both();
  EXPECT_EQ(right.header.frame_id, "d");
  EXPECT_NEAR(left.P[0], 580.0, 0.01);
  left.P[3] = -0.075 * left.P[0];
  EXPECT_EQ(right.P, left.P);
  EXPECT_EQ(right.K, left.K);
  EXPECT_EQ(right.R, left.R);
  EXPECT_EQ(right.D, std::vector<double>(5, 0.0));
  EXPECT_EQ(right.width, 640U);
  EXPECT_EQ(right.height, 480U);
}

TEST_F(DriverControls, TheSceneIsSeenFromTheTiltedCamera) {
  ASSERT_TRUE(manager_.loadDriver("/camera", still("M2")));
  ros::Publisher tilt = node_.advertise<std_msgs::Float64>("tilt_angle", 1);
  Images images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3 && tilt.getNumSubscribers() > 0; }));
  // [m] straight ahead: the wall's near side is at 2.95 m.
  const auto ahead = [&] {
    const auto& image = *images.last();
    return 0.001 * *reinterpret_cast<const std::uint16_t*>(&image.data[240 * image.step + 2 * 600]);
  };
  const auto wall = [](double angle) {
    const double row = (240 - 239.5) / 580.0;  // down
    return 2.95 / (std::cos(angle) + row * std::sin(angle));
  };
  EXPECT_NEAR(ahead(), wall(-0.1), 0.001);
  tilt.publish(holding<std_msgs::Float64>(0.1));
  EXPECT_TRUE(spinUntil([&] { return std::abs(ahead() - wall(0.0)) < 0.001; })) << ahead();
}

TEST_F(DriverControls, TheLightShowsWhatIsAskedFor) {
  const std::string uri = still("M3");
  ASSERT_TRUE(manager_.loadDriver("/camera", uri));
  ros::Publisher led = node_.advertise<std_msgs::UInt16>("led_option", 1);
  ASSERT_TRUE(spinUntil([&] { return led.getNumSubscribers() > 0; }));
  for (std::uint16_t option = 0; option <= 6; ++option) {
    led.publish(holding<std_msgs::UInt16>(option));
    EXPECT_TRUE(spinUntil([&] { return Probe(uri).led() == option; })) << option;
  }
  Diagnostics diagnostics(node_);
  const auto told = [&](const char* key) {
    return diagnostics.value("camera/driver: camera", key);
  };
  EXPECT_TRUE(spinUntil(
      [&] { return told("motor and light") == "yes" && told("accelerometer") == "yes"; }));
  LogLines log;
  led.publish(holding<std_msgs::UInt16>(std::uint16_t{7}));
  EXPECT_TRUE(spinUntil([&] { return log.count("blinking red and yellow, got 7") == 1; }));
  EXPECT_EQ(Probe(uri).led(), 6);
}

}  // namespace
}  // namespace dominant_plane_detection
