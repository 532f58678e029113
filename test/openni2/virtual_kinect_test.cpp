// The virtual Kinect through the real OpenNI2 runtime.

#include "virtual_kinect/virtual_kinect.h"

#include <OpenNI.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "dominant_plane_detection/depth_calibration.h"
#include "openni2/runtime.h"
#include "support/oni_recording.h"
#include "synthetic/scene.h"
#include "virtual_kinect/scene_camera.h"
#include "virtual_kinect/virtual_uri.h"

namespace dominant_plane_detection {
namespace {

using virtual_kinect::FrameRecord;
using virtual_kinect::VirtualUri;

class VirtualKinect : public testing::Test {
 protected:
  void open(const std::string& options = "") {
    device_ = runtime_->open("virtual://rubbish_bin" + options);
  }
  ~VirtualKinect() override {
    frame_.release();
    stream_.destroy();
    if (device_) runtime_->close(std::move(device_));
  }
  /// Starts a sensor in the first of its modes that fits.
  void start(openni::SensorType sensor, openni::PixelFormat format, int width, int rate) {
    ASSERT_EQ(stream_.create(*device_, sensor), openni::STATUS_OK);
    openni::VideoMode mode;
    mode.setPixelFormat(format);
    mode.setResolution(width, width * 3 / 4);
    mode.setFps(rate);
    ASSERT_EQ(stream_.setVideoMode(mode), openni::STATUS_OK);
    ASSERT_EQ(stream_.start(), openni::STATUS_OK) << lastOpenNi2Error();
  }
  bool read() {
    openni::VideoStream* streams[] = {&stream_};
    int ready = 0;
    return openni::OpenNI::waitForAnyStream(streams, 1, &ready, kFramePatience) ==
               openni::STATUS_OK &&
           stream_.readFrame(&frame_) == openni::STATUS_OK;
  }
  FrameRecord record() {
    FrameRecord records[256];
    int size = sizeof(records);
    EXPECT_EQ(device_->getProperty(virtual_kinect::kFrameRecords, records, &size),
              openni::STATUS_OK);
    for (const FrameRecord& record : records) {
      if (record.timestamp == frame_.getTimestamp()) return record;
    }
    ADD_FAILURE() << "no record of the frame";
    return {};
  }
  static Scene scene() { return loadScene(std::string(DPD_SOURCE) + "/scenes/rubbish_bin.yaml"); }

  std::shared_ptr<OpenNi2Runtime> runtime_ = OpenNi2Runtime::instance();
  std::unique_ptr<openni::Device> device_;
  openni::VideoStream stream_;
  openni::VideoFrameRef frame_;
};

TEST_F(VirtualKinect, ListsItsModesAndItsSerialNumber) {
  open("?serial=ABC");
  EXPECT_EQ(serialNumber(*device_), "ABC");
  for (const auto sensor : {openni::SENSOR_DEPTH, openni::SENSOR_COLOR, openni::SENSOR_IR}) {
    EXPECT_TRUE(device_->hasSensor(sensor));
  }
  EXPECT_EQ(device_->getSensorInfo(openni::SENSOR_DEPTH)->getSupportedVideoModes().getSize(), 6);
  EXPECT_TRUE(device_->isImageRegistrationModeSupported(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR));
}

TEST_F(VirtualKinect, DepthIsThatOfTheScene) {
  open("?serial=D");
  const virtual_kinect::SceneCamera camera(scene());
  for (const int width : {640, 320}) {
    start(openni::SENSOR_DEPTH, openni::PIXEL_FORMAT_DEPTH_1_MM, width, 30);
    ASSERT_TRUE(read());
    const FrameRecord told = record();
    const auto pixels = static_cast<std::size_t>(width * width * 3 / 4);
    std::vector<std::uint16_t> expected(pixels);
    camera.depth(told.scene_time, false, width, width * 3 / 4, told.frame_number, expected.data());
    const auto* readings = static_cast<const std::uint16_t*>(frame_.getData());
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), readings)) << width;
    EXPECT_EQ(told.address, reinterpret_cast<std::uint64_t>(frame_.getData()));
    EXPECT_NEAR(stream_.getHorizontalFieldOfView(), 2.0 * std::atan(320.0 / 580.0), 1e-6);
    frame_.release();
    stream_.destroy();
  }
}

TEST_F(VirtualKinect, RawDisparityIsDepthByTheReciprocalForm) {
  open("?serial=R&noise=0");
  start(openni::SENSOR_DEPTH, openni::PIXEL_FORMAT_SHIFT_9_2, 640, 30);
  ASSERT_TRUE(read());
  const FrameRecord told = record();
  Scene clean = scene();
  clean.noise = SensorNoise::none();
  std::vector<std::uint16_t> depth(640 * 480);
  virtual_kinect::SceneCamera(clean).depth(told.scene_time, false, 640, 480, told.frame_number,
                                           depth.data());
  const auto* raw = static_cast<const std::uint16_t*>(frame_.getData());
  const DepthCalibration calibration = DepthCalibration::kinect();
  int readings = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] == 0) {
      EXPECT_EQ(raw[i], 2047);
      continue;
    }
    ++readings;
    const double z = 0.001 * depth[i];
    const double step = -calibration.b * z * z;  // [m] half of it is the rounding
    ASSERT_NEAR(calibration.distance(raw[i]), z, 0.51 * step + 1e-6) << raw[i];
  }
  EXPECT_GT(readings, 200000);
}

TEST_F(VirtualKinect, ColourAndInfraredExcludeEachOther) {
  open("?serial=C");
  start(openni::SENSOR_COLOR, openni::PIXEL_FORMAT_RGB888, 640, 30);
  ASSERT_TRUE(read());
  EXPECT_EQ(frame_.getDataSize(), 3 * 640 * 480);
  openni::VideoStream infrared;
  ASSERT_EQ(infrared.create(*device_, openni::SENSOR_IR), openni::STATUS_OK);
  EXPECT_NE(infrared.start(), openni::STATUS_OK);
  EXPECT_NE(lastOpenNi2Error().find("only one of them can stream"), std::string::npos);
  frame_.release();
  stream_.destroy();
  EXPECT_EQ(infrared.start(), openni::STATUS_OK);
  infrared.destroy();
}

TEST_F(VirtualKinect, ClockDriftsAsTold) {
  open("?serial=T&drift=0.5&noise=0");
  start(openni::SENSOR_DEPTH, openni::PIXEL_FORMAT_DEPTH_1_MM, 320, 60);
  ASSERT_TRUE(read());
  const FrameRecord first = record();
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(read());
  const FrameRecord last = record();
  const double device = 1e-6 * static_cast<double>(last.timestamp - first.timestamp);
  const double scene_time = last.scene_time - first.scene_time;
  EXPECT_NEAR(device / scene_time, 1.5, 1e-3);
}

TEST_F(VirtualKinect, RecordingPlaysBackEqual) {
  const std::string file = std::filesystem::temp_directory_path() /
                           ("dpd_recording_" + std::to_string(getpid()) + ".oni");
  constexpr int kFrames = 10;
  const auto recorded = recordOni("virtual://rubbish_bin?serial=O", file, kFrames);
  device_ = runtime_->open(file);
  device_->getPlaybackControl()->setSpeed(-1.0F);
  device_->getPlaybackControl()->setRepeatEnabled(false);
  ASSERT_EQ(stream_.create(*device_, openni::SENSOR_DEPTH), openni::STATUS_OK);
  EXPECT_NEAR(stream_.getHorizontalFieldOfView(), 2.0 * std::atan(320.0 / 580.0), 1e-5);
  ASSERT_EQ(stream_.start(), openni::STATUS_OK);
  std::vector<std::vector<std::uint16_t>> played;
  const int frames = device_->getPlaybackControl()->getNumberOfFrames(stream_);
  for (int i = 0; i < frames; ++i) played.push_back(readDepth(stream_));
  // What was read meanwhile need not be every frame, and the recorder may have begun with a later
  // one or ended with an earlier one.
  auto from = played.begin();
  int equal = 0;
  bool ended = false;
  for (const auto& frame : recorded) {
    const auto found = std::find(from, played.end(), frame);
    ended = ended || (equal > 0 && found == played.end());
    if (found == played.end()) continue;
    EXPECT_FALSE(ended) << "frame " << found - played.begin() << " comes after one that is missing";
    from = std::next(found);
    ++equal;
  }
  EXPECT_GE(equal, kFrames / 2);
  std::filesystem::remove(file);
}

TEST_F(VirtualKinect, SaysWhatIsWrongWithAUri) {
  const auto error = [&](const std::string& uri) -> std::string {
    try {
      runtime_->close(runtime_->open(uri));
    } catch (const std::runtime_error& exception) {
      return exception.what();
    }
    return "";
  };
  EXPECT_NE(error("virtual://rubbish_bin?nose=1").find("there is no option 'nose'"),
            std::string::npos);
  EXPECT_NE(error("virtual://rubbish_bin?start=x").find("start: expected a number"),
            std::string::npos);
  EXPECT_NE(error("virtual://rubbish_bin?sensor=sonar").find("there is no sensor 'sonar'"),
            std::string::npos);
  EXPECT_NE(error("virtual:///no/such/scene.yaml").find("/no/such/scene.yaml"), std::string::npos);
}

TEST(VirtualUriTest, ParsesWhatUsersWrite) {
  const VirtualUri uri = virtual_kinect::parseUri(
      "virtual:///a/"
      "b.yaml?serial=S1&sensor=realsense&noise=0&start=2.5&drift=75e-6&unplug=3&replug=1&stall=4",
      "/s");
  EXPECT_EQ(uri.scene, "/a/b.yaml");
  EXPECT_EQ(uri.serial, "S1");
  EXPECT_FALSE(uri.noise);
  EXPECT_EQ(uri.sensor, "realsense");
  EXPECT_EQ(uri.start, 2.5);
  EXPECT_EQ(uri.drift, 75e-6);
  EXPECT_EQ(uri.unplug, 3.0);
  EXPECT_EQ(uri.replug, 1.0);
  EXPECT_EQ(uri.stall, 4.0);
  EXPECT_EQ(virtual_kinect::parseUri("virtual://bin", "/s").scene, "/s/bin.yaml");
  EXPECT_EQ(virtual_kinect::parseUri("virtual://bin.yaml", "/s").scene, "/s/bin.yaml");
}

TEST(SceneCameraTest, DrivesForthAndBack) {
  Scene scene;
  scene.path.keys.resize(2);
  scene.path.keys[1].time = 10.0;
  const virtual_kinect::SceneCamera camera(scene);
  EXPECT_DOUBLE_EQ(camera.sceneTime(3.0), 3.0);
  EXPECT_DOUBLE_EQ(camera.sceneTime(13.0), 7.0);
  EXPECT_DOUBLE_EQ(camera.sceneTime(23.0), 3.0);
}

}  // namespace
}  // namespace dominant_plane_detection
