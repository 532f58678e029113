// What users set of a camera while it runs, by the driver nodelet with a virtual Kinect.

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <cmath>

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

}  // namespace
}  // namespace dominant_plane_detection
