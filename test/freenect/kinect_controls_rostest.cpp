// What users set of a Kinect, through OpenNI2 and the plug-in, on a libfreenect without USB.

#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/Float64.h>
#include <std_msgs/UInt16.h>
#include <std_srvs/Trigger.h>

#include <cmath>

#include "freenect/kinect_usb.h"
#include "libfreenect.h"
#include "support/diagnostics.h"
#include "support/log_lines.h"
#include "support/reconfigure.h"

namespace dominant_plane_detection {
namespace {

using KinectControls = KinectUsb;

TEST_F(KinectControls, ExposureIsSetAndGainIsRefused) {
  Kinect kinect;
  kinect.longest_exposure = 100000;
  freenect_double::plug("A1", kinect);
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1", {{"exposure", "8000"}, {"gain", "7"}}));
  LogLines log;
  Listener<sensor_msgs::Image> images(node_, "rgb/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
  EXPECT_EQ(freenect_double::exposure("A1"), 0) << "auto_exposure is on";
  const std::string driver = "/camera/driver";
  EXPECT_FALSE(change(driver, "auto_exposure", false));
  EXPECT_EQ(freenect_double::exposure("A1"), 8000) << "[us]";
  EXPECT_EQ(change(driver, "exposure", 30000), 30000);
  EXPECT_EQ(freenect_double::exposure("A1"), 30000);
  // The Kinect forgets it when the stream begins anew.
  EXPECT_EQ(change(driver, "rgb_mode", std::string("1280x1024@10")), "1280x1024@10");
  ASSERT_TRUE(spinUntil([&] { return images.last()->width == 1280; }));
  EXPECT_EQ(freenect_double::exposure("A1"), 30000);

  EXPECT_EQ(change(driver, "exposure", 150000), 30000) << "the device does not take it";
  EXPECT_EQ(log.count("exposure: the camera refuses 150000: "), 1U);
  EXPECT_EQ(freenect_double::exposure("A1"), 30000);
  EXPECT_TRUE(change(driver, "auto_exposure", true));
  EXPECT_EQ(freenect_double::exposure("A1"), 0) << "it is not set again";
  EXPECT_EQ(change(driver, "gain", 8), 7) << "a Kinect has none";
  EXPECT_EQ(log.count("gain: the camera does not let it be set, got 8, expected 0"), 1U);
}

TEST_F(KinectControls, ItsMotorIsMovedInDegreesAndTellsItsAngleInRadians) {
  freenect_double::plug("A1");
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  ros::Publisher tilt = node_.advertise<std_msgs::Float64>("tilt_angle", 1);
  ros::Publisher led = node_.advertise<std_msgs::UInt16>("led_option", 1);
  Listener<std_msgs::Float64> angles(node_, "cur_tilt_angle");
  ASSERT_TRUE(spinUntil([&] {
    return angles.size() >= 1 && tilt.getNumSubscribers() > 0 && led.getNumSubscribers() > 0;
  }));
  EXPECT_EQ(freenect_double::motor("A1").led, -1) << "nobody has asked for anything";
  std_msgs::Float64 angle;
  angle.data = -20.0 * M_PI / 180.0;
  tilt.publish(angle);
  EXPECT_TRUE(spinUntil([&] { return std::abs(angles.last()->data - angle.data) < 1e-9; }));
  EXPECT_NEAR(freenect_double::motor("A1").degrees, -20.0, 1e-9);
  std_msgs::UInt16 option;
  option.data = LED_BLINK_RED_YELLOW;
  led.publish(option);
  EXPECT_TRUE(spinUntil([&] { return freenect_double::motor("A1").led == LED_BLINK_RED_YELLOW; }));
  // While it moves it does not know its angle, and says -64 degrees.
  freenect_double::Motor motor = freenect_double::motor("A1");
  motor.moves = true;
  freenect_double::setMotor("A1", motor);
  Listener<sensor_msgs::Imu> readings(node_, "imu/data_raw");
  ASSERT_TRUE(spinUntil([&] { return readings.size() >= 10; }));
  motor.moves = false;
  motor.degrees = 5.0;
  freenect_double::setMotor("A1", motor);
  ASSERT_TRUE(spinUntil([&] { return std::abs(angles.last()->data - 5.0 * M_PI / 180.0) < 1e-9; }));
  for (const auto& message : angles.messages()) EXPECT_GT(message->data, -0.55);
}

TEST_F(KinectControls, AnOrderToTheMotorWaitsForTheKinect) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  ros::Publisher tilt = node_.advertise<std_msgs::Float64>("tilt_angle", 1);
  ASSERT_TRUE(spinUntil([&] { return tilt.getNumSubscribers() > 0; }));
  std_msgs::Float64 angle;
  angle.data = 0.25;
  tilt.publish(angle);
  // The session has had it for a while: diagnostics are reported once a second.
  Listener<diagnostic_msgs::DiagnosticArray> reports(node_, "/diagnostics");
  ASSERT_TRUE(spinUntil([&] { return reports.size() >= 3; }));
  freenect_double::plug("A1");
  EXPECT_TRUE(spinUntil(
      [] { return std::abs(freenect_double::motor("A1").degrees - 0.25 * 180.0 / M_PI) < 1e-9; }));
}

TEST_F(KinectControls, WithoutItsMotorACameraIsACameraStill) {
  Kinect kinect;
  kinect.has_motor = false;  // a later model without its audio firmware
  freenect_double::plug("A1", kinect);
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  Listener<sensor_msgs::Imu> readings(node_, "imu/data_raw");
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  Listener<std_msgs::Float64> angles(node_, "cur_tilt_angle");
  ros::Publisher led = node_.advertise<std_msgs::UInt16>("led_option", 1);
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3 && led.getNumSubscribers() > 0; }));
  // It says so once.
  LogLines log;
  led.publish(std_msgs::UInt16());
  EXPECT_TRUE(spinUntil([&] { return log.count("it has no motor and no light") == 1; }));
  led.publish(std_msgs::UInt16());
  const std::size_t more = images.size() + 30;
  ASSERT_TRUE(spinUntil([&] { return images.size() >= more; }));
  EXPECT_EQ(log.count("it has no motor and no light"), 1U);
  // And again of the next camera that is opened.
  std_srvs::Trigger reset;
  ASSERT_TRUE(ros::service::call("/camera/reset", reset) && reset.response.success);
  led.publish(std_msgs::UInt16());
  EXPECT_TRUE(spinUntil([&] { return log.count("it has no motor and no light") == 2; }));
  EXPECT_EQ(readings.size(), 0U);
  EXPECT_EQ(angles.size(), 0U);
  Diagnostics diagnostics(node_);
  const auto told = [&](const char* key) {
    return diagnostics.value("camera/driver: camera", key);
  };
  EXPECT_TRUE(
      spinUntil([&] { return told("motor and light") == "no" && told("accelerometer") == "no"; }));
}

}  // namespace
}  // namespace dominant_plane_detection
