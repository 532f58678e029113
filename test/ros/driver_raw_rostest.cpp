// Raw disparity and the accelerometer, by the driver nodelet with a virtual Kinect.

#include <dynamic_reconfigure/Reconfigure.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/disparity_table.h"
#include "support/driver_test.h"
#include "support/oni_recording.h"
#include "support/ros_test.h"
#include "synthetic/scene.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kUri = "virtual://rubbish_bin?serial=RAW";

class DriverRaw : public testing::Test {
 protected:
  using Images = Listener<sensor_msgs::Image>;

  /// @return what holds after a change of one switch.
  bool change(const std::string& name, bool value) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config.bools.resize(1);
    call.request.config.bools[0].name = name;
    call.request.config.bools[0].value = value ? 1 : 0;
    EXPECT_TRUE(ros::service::call("/camera/driver/set_parameters", call));
    for (const auto& one : call.response.config.bools) {
      if (one.name == name) return one.value != 0;
    }
    ADD_FAILURE() << "no " << name;
    return false;
  }

  static const std::uint16_t* pixels(const sensor_msgs::Image& image) {
    return reinterpret_cast<const std::uint16_t*>(image.data.data());
  }

  /// Compares every depth image with the raw one of its stamp.
  static void expectTable(const Images& raw, const Images& depth, const DisparityTable& table) {
    std::size_t compared = 0;
    for (const auto& image : depth.messages()) {
      for (const auto& source : raw.messages()) {
        if (source->header.stamp != image->header.stamp) continue;
        ++compared;
        EXPECT_EQ(image->encoding, "16UC1");
        EXPECT_EQ(source->encoding, "16UC1");
        for (std::size_t i = 0; i < 640U * 480U; ++i) {
          ASSERT_EQ(pixels(*image)[i], table[pixels(*source)[i]]) << "raw " << pixels(*source)[i];
        }
      }
    }
    EXPECT_GE(compared, 5U);
  }

  ros::NodeHandle node_{"/camera"};
  Manager manager_;
};

TEST_F(DriverRaw, DepthIsTheTableOfTheCalibration) {
  const std::string file = "/tmp/dpd_raw_" + std::to_string(getpid()) + ".yaml";
  std::ofstream(file) << "form: exponential\na: 0.3\nb: 0.002\nc: 0.0\nd: 0.0\n";
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri,
                                  {{"raw_disparity", "true"}, {"depth_calibration", file}}));
  Images raw(node_, "depth/disparity_raw");
  Images depth(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return raw.size() >= 10 && depth.size() >= 10; }));
  DepthCalibration calibration;
  calibration.form = DepthCalibration::Form::kExponential;
  calibration.a = 0.3;
  calibration.b = 0.002;
  expectTable(raw, depth, DisparityTable(calibration));
  std::filesystem::remove(file);
}

TEST_F(DriverRaw, CorrectionsAreInTheTable) {
  ASSERT_TRUE(manager_.loadDriver(
      "/camera", kUri, {{"raw_disparity", "true"}, {"z_offset", "0.05"}, {"z_scale", "0.9"}}));
  Images raw(node_, "depth/disparity_raw");
  Images depth(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return raw.size() >= 10 && depth.size() >= 10; }));
  expectTable(raw, depth, DisparityTable(DepthCalibration::kinect(), 0.05, 0.9));
}

TEST_F(DriverRaw, IsTurnedOnAndOffWhileImagesFlow) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=RAW&noise=0"));
  Images raw(node_, "depth/disparity_raw");
  Images depth(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return depth.size() >= 5; }));
  EXPECT_EQ(raw.size(), 0U) << "the camera streams millimetres";
  EXPECT_TRUE(change("raw_disparity", true));
  ASSERT_TRUE(spinUntil([&] { return raw.size() >= 5; }));
  EXPECT_FALSE(change("raw_disparity", false));
  const std::size_t before = raw.size();
  const std::size_t depths = depth.size();
  ASSERT_TRUE(spinUntil([&] { return depth.size() >= depths + 10; }));
  EXPECT_LE(raw.size(), before + 1) << "one may have been on its way";
  // The camera hardly moves from one image to the next: depth is the same both ways, up to the
  // rounding of the raw values.
  double worst = 0.0;
  for (std::size_t k = 1; k < depth.size(); ++k) {
    const std::uint16_t before_z = pixels(*depth.messages()[k - 1])[450 * 640 + 320];
    const std::uint16_t z = pixels(*depth.messages()[k])[450 * 640 + 320];
    worst = std::max(worst, std::abs(1.0 * z - before_z));
  }
  EXPECT_LE(worst, 6.0) << "mm";
}

TEST_F(DriverRaw, RefusesWhatDoesNotGoTogether) {
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri, {{"depth_registration", "true"}}));
  Images registered(node_, "depth_registered/image_raw");
  ASSERT_TRUE(spinUntil([&] { return registered.size() >= 3; }));
  EXPECT_FALSE(change("raw_disparity", true));
  const std::size_t before = registered.size();
  EXPECT_TRUE(spinUntil([&] { return registered.size() >= before + 3; })) << "the old mode stays";
}

TEST_F(DriverRaw, ACalibrationThatCannotBeReadIsReplacedByTheUsualOne) {
  ASSERT_TRUE(manager_.loadDriver(
      "/camera", kUri, {{"raw_disparity", "true"}, {"depth_calibration", "/no/such/file.yaml"}}));
  Images raw(node_, "depth/disparity_raw");
  Images depth(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return raw.size() >= 10 && depth.size() >= 10; }));
  expectTable(raw, depth, DisparityTable(DepthCalibration::kinect()));
}

TEST_F(DriverRaw, RecordingsOfRawDisparityArePlayed) {
  const std::string file = "/tmp/dpd_raw_" + std::to_string(getpid()) + ".oni";
  recordOni(kUri, file, 10, openni::PIXEL_FORMAT_SHIFT_9_2);
  const auto recorded = readOni(file);
  ASSERT_GE(recorded.size(), 10U);
  ASSERT_TRUE(manager_.loadDriver("/camera", file, {{"raw_disparity", "true"}}));
  Images raw(node_, "depth/disparity_raw");
  Images depth(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return raw.size() >= 10 && depth.size() >= 10; }));
  expectTable(raw, depth, DisparityTable(DepthCalibration::kinect()));
  for (const auto& image : raw.messages()) {
    bool known = false;
    for (const auto& frame : recorded) {
      known = known || std::equal(frame.begin(), frame.end(), pixels(*image));
    }
    ASSERT_TRUE(known) << "an image that was not recorded";
  }
  std::filesystem::remove(file);
}

TEST_F(DriverRaw, AccelerometerOfAMovingCamera) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://laboratory?serial=IMU"));
  Listener<sensor_msgs::Imu> readings(node_, "imu/data_raw");
  ASSERT_TRUE(spinUntil([&] { return readings.size() >= 60; }));
  const Scene scene = loadScene(DPD_SOURCE "/scenes/laboratory.yaml");
  double worst = 0.0;
  for (const auto& reading : readings.messages()) {
    const auto& a = reading->linear_acceleration;
    const Eigen::Vector3d felt(a.x, a.y, a.z);
    EXPECT_NEAR(felt.norm(), 9.80665, 1e-6);
    double nearest = 1e9;
    for (double t = 0.0; t < scene.path.duration(); t += 0.01) {
      const Eigen::Vector3d up =
          scene.path.at(t).pose().linear().transpose() * Eigen::Vector3d::UnitZ();
      nearest = std::min(nearest, (felt.normalized() - up).norm());
    }
    worst = std::max(worst, nearest);
  }
  EXPECT_LT(worst, 0.002);  // [rad], of the step through the path
  EXPECT_EQ(readings.last()->orientation_covariance[0], -1.0) << "REP 145: there is none";
  for (std::size_t i = 1; i < readings.size(); ++i) {
    EXPECT_GT(readings.messages()[i]->header.stamp, readings.messages()[i - 1]->header.stamp);
  }
}

TEST_F(DriverRaw, TheTimeOffsetReachesTheAccelerometer) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://laboratory?serial=IMUT",
                                  {{"time_offset", "-0.9"}}));
  Listener<sensor_msgs::Imu> readings(node_, "imu/data_raw");
  ASSERT_TRUE(spinUntil([&] { return readings.size() >= 10; }));
  for (const auto& reading : readings.messages()) {
    EXPECT_LT(reading->header.stamp, ros::Time::now() - ros::Duration(0.89));
  }
}

}  // namespace
}  // namespace dominant_plane_detection
