// Kinects that come, go and fail, through OpenNI2 and the plug-in, on a libfreenect without USB.

#include <dynamic_reconfigure/Reconfigure.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>

#include "freenect/kinect_usb.h"
#include "libfreenect.h"

namespace dominant_plane_detection {
namespace {

std::uint16_t pixel(const sensor_msgs::Image& image, std::uint32_t u, std::uint32_t v) {
  return *reinterpret_cast<const std::uint16_t*>(&image.data[v * image.step + 2 * u]);
}

TEST_F(KinectUsb, SeveralAreToldApartByTheirSerialNumbers) {
  Kinect first, second;
  second.raw = 800;
  freenect_double::plug("A1", first);
  freenect_double::plug("A2", second);
  ASSERT_TRUE(manager_.loadDriver("/camera", "A2"));
  ASSERT_TRUE(manager_.loadDriver("/other", "freenect://A1"));
  ros::NodeHandle other("/other");
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  Listener<sensor_msgs::Image> others(other, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 5 && others.size() >= 5; }));
  EXPECT_EQ(serial("/camera"), "A2");
  EXPECT_EQ(serial("/other"), "A1");
  // By the table that each device has itself.
  EXPECT_EQ(pixel(*images.last(), 5, 7), 800 + freenect_double::kTableOffset);
  EXPECT_EQ(pixel(*others.last(), 5, 7), 700 + freenect_double::kTableOffset);
  EXPECT_EQ(pixel(*images.last(), 0, 7), 0) << "no reading";
}

TEST_F(KinectUsb, OneThatIsPluggedInLaterIsOpened) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.connected(); }));
  EXPECT_EQ(serial(), "");
  freenect_double::plug("A1");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
  EXPECT_EQ(serial(), "A1");
}

TEST_F(KinectUsb, ComesBackAfterItWasUnplugged) {
  freenect_double::plug("A1");
  freenect_double::plug("A2");
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
  freenect_double::unplug("A1");
  ASSERT_TRUE(spinUntil([&] { return serial().empty(); }));
  ASSERT_TRUE(spinUntil([] { return !listed("A1"); }));
  EXPECT_TRUE(listed("A2"));
  const std::size_t before = images.size();
  freenect_double::plug("A1");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= before + 3; }));
  EXPECT_EQ(serial(), "A1");
  for (std::size_t i = 1; i < images.size(); ++i) {
    ASSERT_GT(images.messages()[i]->header.stamp, images.messages()[i - 1]->header.stamp);
  }
}

TEST_F(KinectUsb, AnIdleOneThatIsUnpluggedIsLostAsWell) {
  freenect_double::plug("A1");
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  ASSERT_TRUE(spinUntil([&] { return serial() == "A1"; }));
  freenect_double::unplug("A1");
  EXPECT_TRUE(spinUntil([&] { return serial().empty(); }));
}

TEST_F(KinectUsb, FailedTransfersLoseTheDeviceUntilTheyWorkAgain) {
  freenect_double::plug("A1");
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
  Kinect kinect;
  kinect.transfers_work = false;
  freenect_double::change("A1", kinect);
  ASSERT_TRUE(spinUntil([&] { return serial().empty(); }));
  freenect_double::change("A1", Kinect());
  const std::size_t before = images.size();
  ASSERT_TRUE(spinUntil([&] { return images.size() >= before + 3; }, 40.0));
  EXPECT_EQ(serial(), "A1");
}

TEST_F(KinectUsb, OneThatFailsAtOnceIsOpenedLessAndLessOften) {
  Kinect kinect;
  kinect.transfers_work = false;
  freenect_double::plug("A1", kinect);
  const int before = freenect_double::opened();
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  // Each time once for its serial number and once for its images.
  ASSERT_TRUE(spinUntil([&] { return freenect_double::opened() >= before + 2; }));
  const ros::SteadyTime first = ros::SteadyTime::now();
  ASSERT_TRUE(spinUntil([&] { return freenect_double::opened() >= before + 8; }));
  EXPECT_GE((ros::SteadyTime::now() - first).toSec(), 0.25 + 0.5 + 1.0 - 0.1);
}

TEST_F(KinectUsb, OneThatThisUserMayNotOpenIsWaitedFor) {
  Kinect kinect;
  kinect.may_open = false;
  freenect_double::plug("A1", kinect);
  ASSERT_TRUE(manager_.loadDriver("/camera", "freenect"));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([] { return listed("A1"); }));
  try {
    OpenNi2Runtime::instance()->open("freenect://A1");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("udev"), std::string::npos) << error.what();
  }
  freenect_double::change("A1", Kinect());
  EXPECT_TRUE(spinUntil([&] { return images.size() >= 3; }));
}

TEST_F(KinectUsb, RegisteredDepthIsWhereTheColourCameraSeesIt) {
  freenect_double::plug("A1");
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1", {{"depth_registration", "true"}}));
  Listener<sensor_msgs::Image> images(node_, "depth_registered/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
  const sensor_msgs::Image& image = *images.last();
  EXPECT_EQ(image.header.frame_id, "camera_rgb_optical_frame");
  constexpr std::uint32_t kShift = freenect_double::kRegistrationShift;
  EXPECT_EQ(pixel(image, kShift, 100), 0) << "the first column has no reading";
  EXPECT_EQ(pixel(image, kShift + 1, 100), 700 + freenect_double::kTableOffset);
  EXPECT_EQ(pixel(image, 639, 479), 700 + freenect_double::kTableOffset);
  EXPECT_EQ(pixel(image, 3, 100), 0) << "nothing is seen there";
}

TEST_F(KinectUsb, InfraredIsTheMiddleOfTheSensorsRows) {
  freenect_double::plug("A1");
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  Listener<sensor_msgs::Image> images(node_, "ir/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
  EXPECT_EQ(images.last()->encoding, "mono16");
  EXPECT_EQ(images.last()->height, 480U);
  EXPECT_EQ(pixel(*images.last(), 10, 0), 4);
  EXPECT_EQ(pixel(*images.last(), 10, 479), 483);
}

TEST_F(KinectUsb, ColourInBothSizesAndItsExposure) {
  freenect_double::plug("A1");
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1", {{"auto_exposure", "false"}}));
  Listener<sensor_msgs::Image> images(node_, "rgb/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
  EXPECT_EQ(images.last()->encoding, "rgb8");
  EXPECT_EQ(images.last()->width, 640U);
  EXPECT_EQ(images.last()->data[1000], 100);
  auto flags = freenect_double::flags("A1");
  EXPECT_FALSE(flags.at(FREENECT_AUTO_EXPOSURE));
  EXPECT_TRUE(flags.at(FREENECT_AUTO_WHITE_BALANCE));
  dynamic_reconfigure::Reconfigure call;
  call.request.config.strs.resize(1);
  call.request.config.strs[0].name = "rgb_mode";
  call.request.config.strs[0].value = "1280x1024@10";
  call.request.config.bools.resize(1);
  call.request.config.bools[0].name = "auto_exposure";
  call.request.config.bools[0].value = 1;
  ASSERT_TRUE(ros::service::call("/camera/driver/set_parameters", call));
  ASSERT_TRUE(spinUntil([&] { return images.last()->width == 1280; }));
  EXPECT_EQ(images.last()->height, 1024U);
  flags = freenect_double::flags("A1");
  EXPECT_TRUE(flags.at(FREENECT_AUTO_EXPOSURE));
}

TEST_F(KinectUsb, AccelerometerInTheOpticalFrame) {
  Kinect kinect;
  kinect.acceleration[0] = 1.0;  // to the Kinect's left
  kinect.acceleration[1] = 9.5;  // up
  kinect.acceleration[2] = 2.0;  // forward
  freenect_double::plug("A1", kinect);
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  Listener<sensor_msgs::Imu> readings(node_, "imu/data_raw");
  ASSERT_TRUE(spinUntil([&] { return readings.size() >= 5; }));
  const sensor_msgs::Imu& imu = *readings.last();
  constexpr double kCount = 9.80665 / FREENECT_COUNTS_PER_G;
  EXPECT_NEAR(imu.linear_acceleration.x, -1.0, kCount);
  EXPECT_NEAR(imu.linear_acceleration.y, -9.5, kCount);
  EXPECT_NEAR(imu.linear_acceleration.z, 2.0, kCount);
  EXPECT_EQ(imu.header.frame_id, "camera_depth_optical_frame");
  EXPECT_EQ(imu.orientation_covariance[0], -1.0);
  EXPECT_EQ(imu.angular_velocity_covariance[0], -1.0);
  EXPECT_GT(imu.linear_acceleration_covariance[0], 0.0);
}

TEST_F(KinectUsb, AStreamThatDoesNotStartIsTriedAgain) {
  Kinect kinect;
  kinect.starts = false;
  freenect_double::plug("A1", kinect);
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  Listener<sensor_msgs::Image> depth(node_, "depth/image_raw");
  Listener<sensor_msgs::Image> colour(node_, "rgb/image_raw");
  ASSERT_TRUE(spinUntil([&] { return colour.size() >= 10; })) << "the other one starts";
  EXPECT_EQ(depth.size(), 0U);
  freenect_double::change("A1", Kinect());
  EXPECT_TRUE(spinUntil([&] { return depth.size() >= 3; }));
}

TEST_F(KinectUsb, AStreamThatIsSilentForEverDoesNotHoldUpTheOther) {
  Kinect kinect;
  kinect.sends_video = false;
  freenect_double::plug("A1", kinect);
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1", {{"watchdog_timeout", "0.2"}}));
  Listener<sensor_msgs::Image> colour(node_, "rgb/image_raw");
  Listener<sensor_msgs::Image> depth(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return depth.size() >= 3; }));
  const int opened = freenect_double::opened();
  ASSERT_TRUE(spinUntil([&] { return depth.size() >= 120; }));  // four seconds
  EXPECT_EQ(freenect_double::opened(), opened) << "the device was closed and opened again";
  EXPECT_EQ(colour.size(), 0U);
  freenect_double::change("A1", Kinect());
  EXPECT_TRUE(spinUntil([&] { return colour.size() >= 3; }));
}

TEST_F(KinectUsb, StampsAscendWhereTheDevicesClockBeginsAgain) {
  freenect_double::plug("A1");
  ASSERT_TRUE(manager_.loadDriver("/camera", "A1"));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 30; }));
  for (std::size_t i = 1; i < images.size(); ++i) {
    const double gap =
        (images.messages()[i]->header.stamp - images.messages()[i - 1]->header.stamp).toSec();
    ASSERT_GT(gap, 0.0);
    ASSERT_LT(gap, 1.0);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
