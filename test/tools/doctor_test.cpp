// The command line of doctor on recordings, with one fault in each.

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "support/command.h"
#include "support/oni_recording.h"
#include "support/recordings.h"
#include "tools/doctor_sample.h"

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<const char*>;

/// What becomes of a message; false: it is left out.
struct Fault {
  std::function<bool(sensor_msgs::Image&)> image = [](sensor_msgs::Image&) { return true; };
  std::function<bool(sensor_msgs::CameraInfo&)> info = [](sensor_msgs::CameraInfo&) {
    return true;
  };
};

template <typename Pixel>
void forEachPixel(sensor_msgs::Image& image, const std::function<Pixel(Pixel)>& change) {
  for (std::size_t i = 0; i + sizeof(Pixel) <= image.data.size(); i += sizeof(Pixel)) {
    Pixel pixel;
    std::memcpy(&pixel, &image.data[i], sizeof(pixel));
    pixel = change(pixel);
    std::memcpy(&image.data[i], &pixel, sizeof(pixel));
  }
}

bool mirror(sensor_msgs::Image& image) {
  auto* const pixels = reinterpret_cast<std::uint16_t*>(image.data.data());
  for (std::uint32_t v = 0; v < image.height; ++v) {
    std::reverse(pixels + v * image.width, pixels + (v + 1) * image.width);
  }
  return true;
}

bool turn(sensor_msgs::Image& image) {
  auto* const pixels = reinterpret_cast<std::uint16_t*>(image.data.data());
  std::reverse(pixels, pixels + image.width * image.height);
  return true;
}

std::function<bool(sensor_msgs::Image&)> times(double factor) {
  return [factor](sensor_msgs::Image& image) {
    forEachPixel<std::uint16_t>(image, [factor](std::uint16_t z) {
      return static_cast<std::uint16_t>(std::min(65535.0, factor * z + 0.5));
    });
    return true;
  };
}

bool toFloatMillimetres(sensor_msgs::Image& image) {
  std::vector<float> values;
  forEachPixel<std::uint16_t>(image, [&](std::uint16_t z) {
    values.push_back(static_cast<float>(z));
    return z;
  });
  image.encoding = "32FC1";
  image.step = 4 * image.width;
  image.data.resize(4 * values.size());
  std::memcpy(image.data.data(), values.data(), image.data.size());
  return true;
}

/// A second of a drive towards a bin, and what is made of it.
class Doctor : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("doctor_test_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    const std::string render = std::string(DPD_RENDER_SCENE) + " " + DPD_SOURCE +
                               "/scenes/rubbish_bin.yaml --rate 15 --duration 1 --output ";
    ASSERT_EQ(run(render + path("drive.bag")).status, 0);
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static std::string path(const std::string& name) { return (folder_ / name).string(); }
  static Outcome doctor(const std::string& arguments) {
    return run(std::string(DPD_DOCTOR) + " " + arguments);
  }

  /// Writes planted.bag.
  static std::string plant(const Fault& fault, const std::string& source = path("drive.bag")) {
    rosbag::Bag in(source), out(path("planted.bag"), rosbag::bagmode::Write);
    rosbag::View all(in);
    for (const rosbag::MessageInstance& message : all) {
      const std::string& topic = message.getTopic();
      if (topic == "/camera/depth/image_raw") {
        sensor_msgs::Image image = *message.instantiate<sensor_msgs::Image>();
        if (fault.image(image)) out.write(topic, message.getTime(), image);
      } else if (topic == "/camera/depth/camera_info") {
        sensor_msgs::CameraInfo info = *message.instantiate<sensor_msgs::CameraInfo>();
        if (fault.info(info)) out.write(topic, message.getTime(), info);
      } else {
        out.write(topic, message.getTime(), message);
      }
    }
    return path("planted.bag");
  }
  /// Writes drive.bag with a mount in tf.
  static std::string plantMount(double height, double roll) {
    const Eigen::Quaterniond mount =
        Eigen::AngleAxisd(0.22, Eigen::Vector3d::UnitY()) *
        Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()) *
        Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);  // an optical frame in the camera's
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "base_link";
    transform.child_frame_id = "camera_depth_optical_frame";
    transform.transform.translation.z = height;
    transform.transform.rotation.w = mount.w();
    transform.transform.rotation.x = mount.x();
    transform.transform.rotation.y = mount.y();
    transform.transform.rotation.z = mount.z();
    const std::string bag = plant({});
    rosbag::Bag out(bag, rosbag::bagmode::Append);
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform);
    out.write("/tf_static", ros::Time(1.6e9), message);
    return bag;
  }

  /// One line, of the code, with all words.
  static void expectOnly(const Outcome& outcome, const std::string& code, const Words& words) {
    EXPECT_EQ(outcome.status, 1) << outcome.text;
    EXPECT_EQ(outcome.text.rfind(code + ": ", 0), 0U) << outcome.text;
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    for (const char* word : words) {
      EXPECT_NE(outcome.text.find(word), std::string::npos) << word << " in " << outcome.text;
    }
  }
  static void expectHealthy(const Outcome& outcome, const std::string& what) {
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(outcome.text.rfind("healthy: ", 0), 0U) << outcome.text;
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    EXPECT_NE(outcome.text.find(what), std::string::npos) << outcome.text;
  }

  static fs::path folder_;
};
fs::path Doctor::folder_;

TEST_F(Doctor, FindsNothingInAGoodDrive) {
  expectHealthy(doctor(path("drive.bag")), "16 of 16 images of /camera/depth/image_raw");
  expectHealthy(doctor(plantMount(0.45, 0.0) + " --set base_frame=base_link"), "16 with a plane");
}

TEST_F(Doctor, LooksAtImagesOfFoldersAndOniRecordings) {
  const std::string render = std::string(DPD_RENDER_SCENE) + " " + DPD_SOURCE +
                             "/scenes/rubbish_bin.yaml --rate 2 --duration 1 --output ";
  ASSERT_EQ(run(render + path("images")).status, 0);
  const std::string images = path("images/depth") + " --camera 580,580,319.5,239.5";
  expectHealthy(doctor(images), "3 of 3 depth images, 3 with a plane");
  expectOnly(doctor(images + " --depth-scale 100"), "depth-scale", {"--depth-scale"});
  EXPECT_EQ(doctor(path("images/depth")).status, 2) << "a PNG does not say its camera";
  recordOni("virtual://rubbish_bin?serial=DOCTOR&noise=0", path("drive.oni"), 4);
  expectHealthy(doctor(path("drive.oni")), "with a plane");
  expectOnly(doctor(path("drive.oni") + " --range 0.5,0.7"), "range-max", {"Set range_max to 1"});
}

TEST_F(Doctor, WrongUnit) {
  expectOnly(doctor(plant({times(5.0)})), "depth-scale", {"Multiplied by 0.2", "z_scale"});
  expectOnly(doctor(plant({times(0.1)})), "depth-scale", {"Multiplied by 10", "z_scale"});
  expectOnly(doctor(plant({times(0.001)})), "depth-scale", {"Multiplied by 1000", "16UC1"});
  expectOnly(doctor(plant({toFloatMillimetres})), "depth-scale", {"by 0.001", "32FC1"});
}

TEST_F(Doctor, CameraInfoOfAnotherSize) {
  Fault fault;
  fault.info = [](sensor_msgs::CameraInfo& info) {
    info.width = 320;
    info.height = 240;
    return true;
  };
  expectOnly(doctor(plant(fault)), "camera-info-size", {"640 x 480", "320 x 240", "binning"});
  expectHealthy(doctor(plant(fault) + " --camera 580,580,319.5,239.5"), "16 with a plane");
}

TEST_F(Doctor, CameraInfoThatIsNotCalibrated) {
  Fault fault;
  fault.info = [](sensor_msgs::CameraInfo& info) {
    info.K.fill(0.0);
    return true;
  };
  expectOnly(doctor(plant(fault)), "uncalibrated", {"in K", "depth_camera_info_url"});
  expectHealthy(doctor(plant(fault) + " --set rectified=true"), "16 with a plane");
}

TEST_F(Doctor, NoCameraInfo) {
  Fault fault;
  fault.info = [](sensor_msgs::CameraInfo&) { return false; };
  expectOnly(doctor(plant(fault)), "no-camera-info", {"/camera/depth/camera_info", "--camera"});
}

TEST_F(Doctor, StampsApart) {
  Fault fault;
  fault.info = [](sensor_msgs::CameraInfo& info) {
    info.header.stamp += ros::Duration(0.004);
    return true;
  };
  expectOnly(doctor(plant(fault)), "stamps-apart", {"4.0 ms", "header.stamp"});
}

TEST_F(Doctor, TopicsSwapped) {
  expectOnly(doctor(path("drive.bag") + " --set input=points"), "topics-swapped",
             {"sensor_msgs/PointCloud2", "input to depth"});
  Fault fault;
  fault.image = [](sensor_msgs::Image&) { return false; };
  const std::string bag = plant(fault);
  {
    rosbag::Bag out(bag, rosbag::bagmode::Append);
    out.write("/camera/depth/image_raw", ros::Time(1.6e9), sensor_msgs::PointCloud2());
  }
  expectOnly(doctor(bag), "topics-swapped", {"sensor_msgs/Image", "input to points"});
}

TEST_F(Doctor, WrongEncoding) {
  Fault fault;
  fault.image = [](sensor_msgs::Image& image) {
    image.encoding = "8UC2";
    return true;
  };
  expectOnly(doctor(plant(fault)), "encoding", {"got '8UC2'", "depth/image_raw"});
  expectOnly(doctor(path("drive.bag") + " --topic /camera/rgb/image_raw"), "encoding",
             {"got 'rgb8'", "--topic"});
}

TEST_F(Doctor, MirroredImages) {
  expectOnly(doctor(plant({mirror})), "mirrored", {"on the right", "mirroring off"});
}

TEST_F(Doctor, RangeMaxTooShort) {
  expectOnly(doctor(path("drive.bag") + " --set range_max=0.7"), "range-max",
             {"range_max 1 m instead of 0.7 m", "Set range_max to 1"});
  std::ofstream(path("short.yaml")) << "range_max: 0.7\nbase_frame: ''\n";
  expectOnly(doctor(path("drive.bag") + " --params " + path("short.yaml")), "range-max", {});
}

TEST_F(Doctor, CameraUpsideDown) {
  expectOnly(doctor(plant({turn})), "upside-down", {"mounted upside down", "expected_up_y"});
  expectOnly(doctor(path("drive.bag") + " --set expected_up_y=1"), "upside-down", {});
  expectOnly(doctor(plantMount(0.45, M_PI) + " --set base_frame=base_link"), "upside-down",
             {"tf has the camera upside down"});
}

TEST_F(Doctor, NoTf) {
  expectOnly(doctor(path("drive.bag") + " --set base_frame=base_link"), "no-tf",
             {"base_frame", "static_transform_publisher"});
}

TEST_F(Doctor, TfDisagrees) {
  expectOnly(doctor(plantMount(0.5, 0.0) + " --set base_frame=base_link"), "tf-disagrees",
             {"mm higher than tf", "calibrate_mount", "mount_height"});
  expectOnly(doctor(plantMount(0.45, 0.1) + " --set base_frame=base_link"), "tf-disagrees",
             {"(roll)"});
  expectHealthy(doctor(plantMount(0.5, 0.0)), "16 with a plane");  // tf is not wanted
}

TEST_F(Doctor, NoDepthTopic) {
  Fault fault;
  fault.image = [](sensor_msgs::Image&) { return false; };
  expectOnly(doctor(plant(fault)), "no-images", {"/camera/rgb/image_raw", "record.launch"});
  expectOnly(doctor(path("drive.bag") + " --topic /depth/image_raw"), "no-images",
             {"/depth/image_raw", "/camera/depth/image_raw"});
}

TEST_F(Doctor, PackedDepth) {
  Fault fault;
  fault.image = [](sensor_msgs::Image&) { return false; };
  const std::string bag = plant(fault);
  {
    rosbag::Bag out(bag, rosbag::bagmode::Append);
    sensor_msgs::CompressedImage packed;
    packed.format = "16UC1; compressedDepth";
    out.write("/camera/depth/image_raw/compressedDepth", ros::Time(1.6e9), packed);
  }
  const Words words{"republish compressedDepth in:=/camera/depth/image_raw raw"};
  expectOnly(doctor(bag), "no-images", words);
  expectOnly(doctor(bag + " --topic /camera/depth/image_raw"), "no-images", words);
  expectOnly(doctor(bag + " --topic /camera/depth/image_raw/compressedDepth"), "topics-swapped",
             words);
}

TEST_F(Doctor, ACorrectionIsApplied) {
  std::ofstream(path("correction.yaml")) << "columns: 1\nrows: 1\n"
                                            "inverse_depth: [0.1]\n";
  const std::string arguments = path("drive.bag") + " --set range_max=0.75";
  const std::string file = path("correction.yaml");
  expectOnly(doctor(arguments + " --correction " + file), "range-max", {});
  expectOnly(doctor(arguments + " --set correction=" + file), "range-max", {});
  expectHealthy(doctor(arguments + " --set correction="), "16 with a plane");
  EXPECT_EQ(doctor(arguments + " --correction /no/such.yaml").status, 2);
}

TEST(DoctorSample, IsSpreadOverAllImages) {
  for (const std::size_t few : {0U, 1U, 60U}) EXPECT_EQ(sampleStep(few), 1U) << few;
  EXPECT_EQ(sampleStep(61), 2U);
  EXPECT_EQ(sampleStep(120), 2U);
  EXPECT_EQ(sampleStep(121), 3U);
}

TEST_F(Doctor, WhatItCannotLookAtIsNoFinding) {
  for (const char* arguments : {"--frob", "/no/such.bag", "--duration 0"}) {
    EXPECT_EQ(doctor(arguments).status, 2) << arguments;
  }
  EXPECT_EQ(doctor(path("drive.bag") + " --set frob=1").status, 2);
  EXPECT_EQ(doctor(path("drive.bag") + " --set range_max=-1").status, 2);
  std::ofstream(path("broken.bag")) << "no bag";
  EXPECT_EQ(doctor(path("broken.bag")).status, 2);
  const Outcome no_master = run("ROS_MASTER_URI=http://localhost:1 " DPD_DOCTOR);
  EXPECT_EQ(no_master.status, 2);
  EXPECT_NE(no_master.text.find("no ROS master answers"), std::string::npos) << no_master.text;
  EXPECT_EQ(doctor("--help").status, 0);
}

/// Recordings of real cameras, with nothing wrong in them, and mirrored.
class DoctorOnRecordings : public Doctor {
 protected:
  void SetUp() override {
    if (!fs::exists(recordingsFolder() + "/robot_lab.bag")) {
      GTEST_SKIP() << "no recordings in " << recordingsFolder();
    }
  }
  static std::string recording(const std::string& name) { return recordingsFolder() + "/" + name; }
};

TEST_F(DoctorOnRecordings, FindsNothing) {
  expectHealthy(doctor(recording("robot_lab.bag")), "60 with a plane");
  // A desk, without any floor in most images.
  expectHealthy(doctor(recording("handheld_desk.bag")), "50 of 150");
  expectHealthy(doctor(recording("handheld_desk.bag --set base_frame=world")), "150 of 150");
  expectHealthy(doctor(recording("cabinet/depth --camera 535.4,539.2,320.1,247.6 "
                                 "--depth-scale 5000")),
                "20 with a plane");
  expectHealthy(doctor(recording("low_robot/depth --camera 617.25,617.5486,317.392,245.980")),
                "10 of 10");
}

TEST_F(DoctorOnRecordings, TellsAMirror) {
  expectOnly(doctor(plant({mirror}, recording("robot_lab.bag"))), "mirrored", {});
  expectOnly(doctor(plant({mirror}, recording("handheld_desk.bag"))), "mirrored", {});
}

TEST_F(DoctorOnRecordings, TellsAUnit) {
  expectOnly(doctor(recording("cabinet/depth --camera 535.4,539.2,320.1,247.6")), "depth-scale",
             {"Multiplied by 0.2", "--depth-scale"});
}

}  // namespace
}  // namespace dominant_plane_detection
