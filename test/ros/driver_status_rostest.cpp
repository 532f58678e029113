// What the driver says of its camera and streams, each on its own, and what it does meanwhile.

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <dominant_plane_detection/DominantPlane.h>
#include <dominant_plane_detection/GetSerial.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <future>

#include "support/diagnostics.h"
#include "support/driver_test.h"
#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

using diagnostic_msgs::DiagnosticStatus;

class DriverStatus : public testing::Test {
 protected:
  static constexpr const char* kCamera = "camera/driver: camera";
  static constexpr const char* kDepth = "camera/driver: depth";
  static constexpr const char* kColour = "camera/driver: rgb";
  static constexpr const char* kInfrared = "camera/driver: ir";

  /// @return what holds after a change of one parameter.
  template <typename Value>
  static dynamic_reconfigure::Config change(const std::string& name, const Value& value) {
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, name, value);
    EXPECT_TRUE(ros::service::waitForService("/camera/driver/set_parameters", 10000));
    EXPECT_TRUE(ros::service::call("/camera/driver/set_parameters", call));
    return call.response.config;
  }

  ros::NodeHandle node_{"/camera"};
  Manager manager_;
  Diagnostics diagnostics_{node_};
};

TEST_F(DriverStatus, ACameraThatIsNotThereIsAnError) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "NO-SUCH-SERIAL"));
  EXPECT_TRUE(diagnostics_.waitFor(kDepth, DiagnosticStatus::OK, "idle"));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  EXPECT_TRUE(diagnostics_.waitFor(kCamera, DiagnosticStatus::ERROR, "NO-SUCH-SERIAL"))
      << diagnostics_.message(kCamera);
  EXPECT_TRUE(diagnostics_.waitFor(kDepth, DiagnosticStatus::ERROR, "there is no camera"));
  EXPECT_TRUE(diagnostics_.waitFor(kColour, DiagnosticStatus::OK, "idle"));
}

/// Colour streams, so that infrared cannot: that is infrared's trouble alone.
TEST_F(DriverStatus, AStreamThatCannotStartIsAnErrorOfItsOwn) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=E1"));
  {
    Listener<sensor_msgs::Image> colour(node_, "rgb/image_raw");
    ASSERT_TRUE(spinUntil([&] { return colour.size() >= 3; }));
    Listener<sensor_msgs::Image> infrared(node_, "ir/image_raw");
    EXPECT_TRUE(diagnostics_.waitFor(kInfrared, DiagnosticStatus::ERROR, "only one of them"))
        << diagnostics_.message(kInfrared);
    EXPECT_TRUE(diagnostics_.waitFor(kColour, DiagnosticStatus::OK, "images a second"));
    EXPECT_TRUE(diagnostics_.waitFor(kCamera, DiagnosticStatus::OK, "streaming: rgb"));
    EXPECT_EQ(diagnostics_.value(kInfrared, "state"), "failed");
    EXPECT_EQ(infrared.size(), 0U);
  }
  EXPECT_TRUE(diagnostics_.waitFor(kInfrared, DiagnosticStatus::OK, "idle"));
  Listener<sensor_msgs::Image> infrared(node_, "ir/image_raw");
  EXPECT_TRUE(spinUntil([&] { return infrared.size() >= 3; })) << "once colour has ended";
}

/// A stream that falls silent and does not start again used to take the others with it.
TEST_F(DriverStatus, AStreamThatDoesNotStartAgainLeavesTheOthers) {
  const std::string uri = "virtual://rubbish_bin?serial=E2&noise=0";
  ASSERT_TRUE(manager_.loadDriver("/camera", uri, {{"watchdog_timeout", "0.5"}}));
  Listener<sensor_msgs::Image> depth(node_, "depth/image_raw");
  Listener<sensor_msgs::Image> colour(node_, "rgb/image_raw");
  ASSERT_TRUE(spinUntil([&] { return depth.size() >= 3 && colour.size() >= 3; }));
  Probe(uri).refuseStart(openni::SENSOR_COLOR);
  Probe(uri).stall();  // both
  EXPECT_TRUE(diagnostics_.waitFor(kColour, DiagnosticStatus::ERROR, "does not start"))
      << diagnostics_.message(kColour);
  const std::size_t before = depth.size();
  EXPECT_TRUE(spinUntil([&] { return depth.size() >= before + 60; }));
  EXPECT_TRUE(diagnostics_.waitFor(kDepth, DiagnosticStatus::OK, "images a second"))
      << diagnostics_.message(kDepth);
  EXPECT_EQ(diagnostics_.value(kCamera, "times opened"), "1");
  EXPECT_EQ(diagnostics_.message(kColour).front(), '2');
  Probe(uri).refuseStart(static_cast<openni::SensorType>(0));
  const std::size_t colours = colour.size();
  EXPECT_TRUE(spinUntil([&] { return colour.size() >= colours + 3; }));
  EXPECT_TRUE(diagnostics_.waitFor(kColour, DiagnosticStatus::OK, "images a second"));
}

/// What comes is what the camera has sent, not what it was asked for.
TEST_F(DriverStatus, RegistrationThatFailsIsSaidAndNotPublished) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=E3&registers=0",
                                  {{"depth_registration", "true"}}));
  Listener<sensor_msgs::Image> plain(node_, "depth/image_raw");
  Listener<sensor_msgs::Image> registered(node_, "depth_registered/image_raw");
  ASSERT_TRUE(spinUntil([&] { return plain.size() >= 10; }));
  EXPECT_EQ(registered.size(), 0U);
  EXPECT_EQ(plain.last()->header.frame_id, "camera_depth_optical_frame");
  // And while it runs: refused, with the old value.
  change("depth_registration", false);
  const auto config = change("depth_registration", true);
  bool value = true;
  dynamic_reconfigure::ConfigTools::getParameter(config, "depth_registration", value);
  EXPECT_FALSE(value);
  const std::size_t before = plain.size();
  ASSERT_TRUE(spinUntil([&] { return plain.size() >= before + 10; }));
  EXPECT_EQ(registered.size(), 0U);
}

/// Three quarters of each frame are sent; the memory behind it has an earlier one.
TEST_F(DriverStatus, IncompleteImagesShowNothingThatIsOld) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=E4&noise=0&sent=0.75"));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 30; }));
  for (const auto& image : images.messages()) {
    ASSERT_EQ(image->data.size(), 640U * 480U * 2U);
    const auto rest = image->data.begin() + 640 * 480 * 2 * 3 / 4;
    EXPECT_TRUE(std::all_of(rest, image->data.end(), [](auto byte) { return byte == 0; }));
    EXPECT_TRUE(std::any_of(rest - 1280, rest, [](auto byte) { return byte != 0; }));
  }
  EXPECT_TRUE(spinUntil(
      [&] { return std::atoi(diagnostics_.value(kDepth, "incomplete images").c_str()) >= 30; }));
}

/// While a camera takes its time to open, only who asks it for something waits.
TEST_F(DriverStatus, ParametersThatWaitForTheCameraHoldUpNothingElse) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=E5&slow=10"));
  ASSERT_TRUE(ros::service::waitForService("/camera/driver/set_parameters", 10000));
  auto answer = std::async(std::launch::async,
                           [] { return change("depth_mode", std::string("320x240@60")); });
  GetSerial serial;
  ASSERT_TRUE(ros::service::call("/camera/get_serial", serial));
  EXPECT_EQ(serial.response.serial, "") << "it is not open yet";
  EXPECT_FALSE(isReady(answer));
  ASSERT_TRUE(spinUntil([&] { return isReady(answer); }));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
  EXPECT_EQ(images.last()->width, 320U);
}

TEST_F(DriverStatus, DepthAndColourOfOneExposureHaveOneStamp) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=E6&noise=0"));
  Listener<sensor_msgs::Image> depth(node_, "depth/image_raw");
  Listener<sensor_msgs::Image> colour(node_, "rgb/image_raw");
  ASSERT_TRUE(spinUntil([&] { return depth.size() >= 150 && colour.size() >= 150; }));
  // Until the clock is known a first frame that was late may be stamped by its arrival.
  constexpr std::size_t kFirst = 30;
  std::size_t equal = 0;
  for (std::size_t i = kFirst; i < depth.size(); ++i) {
    for (std::size_t k = kFirst; k < colour.size(); ++k) {
      const ros::Time picture = colour.messages()[k]->header.stamp;
      const double apart = std::abs((depth.messages()[i]->header.stamp - picture).toSec());
      if (apart == 0.0) ++equal;
      EXPECT_TRUE(apart == 0.0 || apart > 0.02) << apart << " s apart";
    }
  }
  std::cout << equal << " of " << depth.size() << " depth images have a picture of their stamp\n";
  EXPECT_GT(equal, 0U) << "some exposures were seen by both";
}

/// OpenNI2 shares the memory of a frame among all who stream the sensor.
TEST_F(DriverStatus, TwoDriversOnOneCameraHaveCorrectionsOfTheirOwn) {
  const std::string uri = "virtual://rubbish_bin?serial=E7&sensor=independent";
  ros::NodeHandle other("/other");
  ASSERT_TRUE(manager_.loadDriver("/camera", uri, {{"z_scale", "1.1"}}));
  ASSERT_TRUE(manager_.loadDriver("/other", uri));
  ASSERT_TRUE(manager_.loadDetection("/camera"));
  ASSERT_TRUE(manager_.loadDetection("/other"));
  Listener<DominantPlane> scaled(node_, "plane_detection/plane");
  Listener<DominantPlane> plain(other, "plane_detection/plane");
  ASSERT_TRUE(spinUntil([&] { return scaled.size() >= 200 && plain.size() >= 200; }, 60.0));
  for (const auto& plane : plain.messages()) ASSERT_NEAR(plane->distance, 0.45, 0.003);
  for (const auto& plane : scaled.messages()) ASSERT_NEAR(plane->distance, 0.495, 0.003);
}

/// As in openni2_camera: whoever has calibrated the infrared camera has calibrated depth.
TEST_F(DriverStatus, ACalibrationOfTheInfraredCameraReachesDepth) {
  const std::string file =
      std::filesystem::temp_directory_path() / ("dpd_ir_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file)
      << "image_width: 640\nimage_height: 480\ncamera_name: ir\n"
         "camera_matrix: {rows: 3, cols: 3, data: [590, 0, 330, 0, 591, 250, 0, 0, 1]}\n"
         "distortion_model: plumb_bob\n"
         "distortion_coefficients: {rows: 1, cols: 5, data: [-0.1, 0.2, 0, 0, 0]}\n"
         "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
         "projection_matrix: {rows: 3, cols: 4, data: [590, 0, 330, 0, 0, 591, 250, 0, 0, 0, 1, "
         "0]}\n";
  ASSERT_TRUE(manager_.loadDriver(
      "/camera", "virtual://rubbish_bin?serial=E8&noise=0",
      {{"ir_camera_info_url", "file://" + file}, {"depth_mode", "320x240@30"}}));
  Listener<sensor_msgs::CameraInfo> depth(node_, "depth/camera_info");
  ASSERT_TRUE(spinUntil([&] { return depth.size() >= 3; }));
  EXPECT_DOUBLE_EQ(depth.last()->K[0], 295.0);
  EXPECT_DOUBLE_EQ(depth.last()->K[2], (330.0 + 0.5) / 2.0 - 0.5 - 2.5);
  EXPECT_DOUBLE_EQ(depth.last()->K[5], (250.0 + 0.5) / 2.0 - 0.5 - 2.0);
  EXPECT_DOUBLE_EQ(depth.last()->P[2], depth.last()->K[2]);
  EXPECT_DOUBLE_EQ(depth.last()->D[0], -0.1);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace dominant_plane_detection
