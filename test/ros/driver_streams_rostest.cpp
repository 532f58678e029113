// The driver nodelet with a virtual Kinect, through the real OpenNI2 runtime.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dominant_plane_detection/DominantPlane.h>
#include <dominant_plane_detection/GetSerial.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <ros/console.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <sstream>

#include "support/driver_test.h"
#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

using diagnostic_msgs::DiagnosticStatus;

/// Keeps the lines of the log with which the detection says where it reads an image.
class ReadAddresses : public ros::console::LogAppender {
 public:
  ReadAddresses() {
    ros::console::set_logger_level("ros.dominant_plane_detection.zero_copy",
                                   ros::console::levels::Debug);
    ros::console::notifyLoggerLevelsChanged();
    ros::console::register_appender(this);
  }
  ~ReadAddresses() override { ros::console::deregister_appender(this); }

  void log(ros::console::Level /*level*/, const char* text, const char* /*file*/,
           const char* /*function*/, int /*line*/) override {
    std::istringstream words(text);
    std::string word, stamp;
    while (words >> word && word != "of") {
    }
    void* address = nullptr;
    if (words >> stamp && words >> word && words >> word && words >> word && words >> address) {
      const std::lock_guard<std::mutex> lock(mutex_);
      addresses_[stamp] = address;
    }
  }
  /// @return where the image of a stamp was read; null if it was not.
  const void* of(const ros::Time& stamp) {
    std::ostringstream text;
    text << stamp;
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = addresses_.find(text.str());
    return found == addresses_.end() ? nullptr : found->second;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, void*> addresses_;
};

class Driver : public testing::Test {
 protected:
  static constexpr const char* kUri = "virtual://rubbish_bin?serial=VK1";

  ros::NodeHandle node_{"/camera"};
  Manager manager_;
};

TEST_F(Driver, NothingIsCopiedFromTheSensorToThePlane) {
  ReadAddresses read;
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri));
  ASSERT_TRUE(manager_.loadDetection("/camera"));
  Listener<DominantPlane> planes(node_, "plane_detection/plane");
  // Images are kept, so that no buffer is used twice.
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return planes.size() >= 40; }));
  const auto records = Probe(kUri).records();
  int compared = 0;
  for (const auto& image : images.messages()) {
    const void* seen_by_detection = read.of(image->header.stamp);
    const auto written = recordAt(records, image->data.data());
    if (seen_by_detection == nullptr) continue;  // not read yet, or before our subscription
    ASSERT_TRUE(written) << "the image that the subscriber got was not written by the plug-in";
    EXPECT_EQ(seen_by_detection, image->data.data());
    if (compared++ < 3) {
      std::cout << "frame " << written->frame_number << ": written at 0x" << std::hex
                << written->address << std::dec << ", read by the detection at "
                << seen_by_detection << ", received by a subscriber at "
                << static_cast<const void*>(image->data.data()) << '\n';
    }
  }
  EXPECT_GE(compared, 30);
}

TEST_F(Driver, ImagesInfosAndPlanesHaveTheSameStamps) {
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri));
  ASSERT_TRUE(manager_.loadDetection("/camera"));
  Listener<DominantPlane> planes(node_, "plane_detection/plane");
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  Listener<sensor_msgs::CameraInfo> infos(node_, "depth/camera_info");
  ASSERT_TRUE(spinUntil([&] { return planes.size() >= 92 && infos.size() >= 92; }));

  std::map<ros::Time, sensor_msgs::ImageConstPtr> by_stamp;
  for (const auto& image : images.messages()) by_stamp[image->header.stamp] = image;
  ASSERT_EQ(by_stamp.size(), images.size()) << "stamps come once";
  const auto records = Probe(kUri).records();
  std::vector<double> errors;
  std::vector<double> spacings;
  ros::Time last;
  for (const auto& image : images.messages()) {
    EXPECT_EQ(image->header.frame_id, "camera_depth_optical_frame");
    EXPECT_EQ(image->encoding, "16UC1");
    EXPECT_EQ(image->data.size(), 640U * 480U * 2U);
    EXPECT_GT(image->header.stamp, last);
    if (!last.isZero()) spacings.push_back((image->header.stamp - last).toSec());
    last = image->header.stamp;
    const auto record = recordAt(records, image->data.data());
    if (!record) continue;
    const double exposed = 1e-9 * static_cast<double>(record->exposed);
    errors.push_back(std::abs(image->header.stamp.toSec() - exposed));
  }
  std::sort(spacings.begin(), spacings.end());
  EXPECT_NEAR(spacings[spacings.size() / 2], 1.0 / 30.0, 0.001);
  // By the device's clock it is exact; what is left is the least time that a frame was on its way.
  std::sort(errors.begin(), errors.end());
  ASSERT_GE(errors.size(), 60U);
  std::cout << "stamps against the true exposure: median " << 1e3 * errors[errors.size() / 2]
            << " ms, worst " << 1e3 * errors.back() << " ms\n";
  EXPECT_LT(errors[errors.size() / 2], 0.005);

  for (const auto& info : infos.messages()) {
    if (info->header.stamp > last || info->header.stamp < by_stamp.begin()->first) continue;
    EXPECT_EQ(by_stamp.count(info->header.stamp), 1U);
    EXPECT_EQ(info->header.frame_id, "camera_depth_optical_frame");
    EXPECT_NEAR(info->K[0], 580.0, 0.01);  // the scene's camera
    EXPECT_NEAR(info->K[2], 319.5, 1e-9);
    EXPECT_EQ(info->width, 640U);
  }
  std::size_t missing = 0;
  for (const auto& [stamp, image] : by_stamp) {
    const bool found =
        std::any_of(planes.messages().begin(), planes.messages().end(),
                    [&, s = stamp](const auto& plane) { return plane->header.stamp == s; });
    const bool within =
        stamp >= planes.messages().front()->header.stamp && stamp <= planes.last()->header.stamp;
    if (within && !found) ++missing;
  }
  std::cout << images.size() << " images, " << missing << " without a plane\n";
  EXPECT_LE(missing, images.size() / 30) << "only the newest image waits";
}

TEST_F(Driver, AHoarderNeverSeesItsImagesChange) {
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri));
  struct Kept {
    sensor_msgs::ImageConstPtr image;
    std::vector<std::uint8_t> copy;
  };
  std::vector<Kept> kept;
  const ros::Subscriber hoarder = node_.subscribe<sensor_msgs::Image>(
      "depth/image_raw", 100, [&](const sensor_msgs::ImageConstPtr& image) {
        kept.push_back({image, image->data});
      });
  ASSERT_TRUE(spinUntil([&] { return kept.size() >= 60; }));
  std::set<const void*> buffers;
  for (const Kept& one : kept) {
    EXPECT_TRUE(one.image->data == one.copy);
    buffers.insert(one.image->data.data());
  }
  EXPECT_EQ(buffers.size(), kept.size());
}

TEST_F(Driver, BuffersAreUsedAgainWhenNobodyKeepsThem) {
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri));
  std::map<const void*, int> buffers;
  int images = 0;
  const ros::Subscriber subscriber =
      node_.subscribe<sensor_msgs::Image>("depth/image_raw", 1, [&](const auto& image) {
        ++buffers[image->data.data()];
        ++images;
      });
  ASSERT_TRUE(spinUntil([&] { return images >= 60; }));
  EXPECT_LE(buffers.size(), 8U);
}

TEST_F(Driver, StreamsRunWhileSomebodyListens) {
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri));
  Listener<diagnostic_msgs::DiagnosticArray> diagnostics(node_, "/diagnostics");
  const auto report = [&](const std::string& part, const std::string& text) {
    for (const auto& array : diagnostics.messages()) {
      for (const auto& status : array->status) {
        const bool about =
            status.name.size() >= part.size() &&
            status.name.compare(status.name.size() - part.size(), part.size(), part) == 0;
        if (about && status.message.find(text) != std::string::npos &&
            status.level == DiagnosticStatus::OK && status.hardware_id == "VK1") {
          return true;
        }
      }
    }
    return false;
  };
  // Idle is well.
  ASSERT_TRUE(spinUntil([&] { return report(": camera", "idle") && report(": depth", "idle"); }));
  EXPECT_TRUE(Probe(kUri).records().empty());
  {
    Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
    ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
    EXPECT_FALSE(Probe(kUri).records().empty());
    ASSERT_TRUE(spinUntil([&] { return report(": camera", "streaming"); }));
    ASSERT_TRUE(spinUntil([&] { return report(": depth", "30 by the mode"); }));
  }
  const auto stopped = [&] {
    const auto before = Probe(kUri).records().back().timestamp;
    ros::WallDuration(0.2).sleep();  // six frames of a stream that runs
    return Probe(kUri).records().back().timestamp == before;
  };
  EXPECT_TRUE(spinUntil(stopped));
}

TEST_F(Driver, ColourAndInfraredComeWithTheirInfo) {
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri));
  {
    Listener<sensor_msgs::Image> colour(node_, "rgb/image_raw");
    Listener<sensor_msgs::CameraInfo> info(node_, "rgb/camera_info");
    ASSERT_TRUE(spinUntil([&] { return colour.size() >= 3 && info.size() >= 3; }));
    EXPECT_EQ(colour.last()->encoding, "rgb8");
    EXPECT_EQ(colour.last()->step, 3U * 640U);
    EXPECT_EQ(colour.last()->header.frame_id, "camera_rgb_optical_frame");
    EXPECT_EQ(info.last()->header.frame_id, "camera_rgb_optical_frame");
    // The bin is bluer than it is red, the wall before it is not.
    const auto& image = *colour.messages().front();
    const auto pixel = [&](int u, int v) {
      return &image
                  .data[static_cast<std::size_t>(v) * image.step + 3 * static_cast<std::size_t>(u)];
    };
    EXPECT_GT(pixel(307, 150)[2], pixel(307, 150)[0]);
    EXPECT_LT(pixel(315, 20)[2], pixel(315, 20)[0]);
    // Infrared has to wait for colour to end.
    Listener<sensor_msgs::Image> infrared(node_, "ir/image_raw");
    const std::size_t before = colour.size();
    ASSERT_TRUE(spinUntil([&] { return colour.size() >= before + 15; }));
    EXPECT_EQ(infrared.size(), 0U);
  }
  Listener<sensor_msgs::Image> infrared(node_, "ir/image_raw");
  Listener<sensor_msgs::CameraInfo> info(node_, "ir/camera_info");
  ASSERT_TRUE(spinUntil([&] { return infrared.size() >= 3 && info.size() >= 3; }));
  EXPECT_EQ(infrared.last()->encoding, "mono16");
  EXPECT_EQ(infrared.last()->header.frame_id, "camera_depth_optical_frame");
}

TEST_F(Driver, AModeThatTheCameraDoesNotHaveIsReplacedAtTheStart) {
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri, {{"depth_mode", "1280x1024@30"}}));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 3; }));
  EXPECT_EQ(images.last()->width, 640U);
}

TEST_F(Driver, CalibrationOfAFileIsScaledToTheImages) {
  const std::string file =
      std::filesystem::temp_directory_path() / ("depth_VK1_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file)
      << "image_width: 320\nimage_height: 240\ncamera_name: depth_VK1\n"
         "camera_matrix: {rows: 3, cols: 3, data: [300, 0, 150, 0, 301, 120, 0, 0, 1]}\n"
         "distortion_model: plumb_bob\n"
         "distortion_coefficients: {rows: 1, cols: 5, data: [0.1, 0, 0, 0, 0]}\n"
         "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
         "projection_matrix: {rows: 3, cols: 4, data: [300, 0, 150, 0, 0, 301, 120, 0, 0, 0, 1, "
         "0]}\n";
  std::string url = "file://" + file;
  url.replace(url.find("depth_VK1"), 9, "${NAME}");
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri, {{"depth_camera_info_url", url}}));
  Listener<sensor_msgs::CameraInfo> infos(node_, "depth/camera_info");
  Listener<sensor_msgs::CameraInfo> projectors(node_, "projector/camera_info");
  ASSERT_TRUE(spinUntil([&] { return infos.size() >= 1 && projectors.size() >= 1; }));
  EXPECT_DOUBLE_EQ(projectors.last()->K[0], 600.0);
  EXPECT_DOUBLE_EQ(projectors.last()->D[0], 0.0);
  EXPECT_DOUBLE_EQ(projectors.last()->P[3], -0.075 * 600.0);
  EXPECT_DOUBLE_EQ(infos.last()->K[0], 600.0);
  EXPECT_DOUBLE_EQ(infos.last()->K[2], 300.5);
  EXPECT_DOUBLE_EQ(infos.last()->K[4], 602.0);
  EXPECT_DOUBLE_EQ(infos.last()->D[0], 0.1);
  EXPECT_EQ(infos.last()->width, 640U);
  std::filesystem::remove(file);
}

TEST_F(Driver, TwoDriversMayHaveTheSameCamera) {
  ros::NodeHandle other("/other");
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 5; }));
  ASSERT_TRUE(manager_.loadDriver("/other", kUri));
  {
    Listener<sensor_msgs::Image> others(other, "depth/image_raw");
    ASSERT_TRUE(spinUntil([&] { return others.size() >= 20; }));
    // Of one exposure, in whose memory it may be.
    const auto& pixels = others.last()->data;
    EXPECT_TRUE(spinUntil([&] {
      return std::any_of(images.messages().begin(), images.messages().end(),
                         [&](const auto& image) { return image->data == pixels; });
    }));
  }
  ASSERT_TRUE(manager_.unload("/other/driver"));
  const std::size_t before = images.size();
  ASSERT_TRUE(spinUntil([&] { return images.size() >= before + 20; }));
  ASSERT_TRUE(manager_.unload("/camera/driver"));
}

class DriverParameterChange : public Driver {
 protected:
  /// @return what holds after a change of one parameter.
  template <typename Value>
  dynamic_reconfigure::Config change(const std::string& name, const Value& value) {
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, name, value);
    EXPECT_TRUE(
        spinUntil([] { return ros::service::exists("/camera/driver/set_parameters", false); }));
    EXPECT_TRUE(ros::service::call("/camera/driver/set_parameters", call));
    return call.response.config;
  }
  static std::string text(const dynamic_reconfigure::Config& config, const std::string& name) {
    for (const auto& one : config.strs) {
      if (one.name == name) return one.value;
    }
    return "";
  }
};

TEST_F(DriverParameterChange, ModeChangesWhileImagesFlow) {
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri));
  Listener<sensor_msgs::Image> images(node_, "depth/image_raw");
  Listener<sensor_msgs::CameraInfo> infos(node_, "depth/camera_info");
  ASSERT_TRUE(spinUntil([&] { return images.size() >= 5; }));
  EXPECT_EQ(images.last()->width, 640U);
  EXPECT_EQ(text(change("depth_mode", std::string("320x240@60")), "depth_mode"), "320x240@60");
  ASSERT_TRUE(spinUntil([&] { return images.last()->width == 320; }));
  const std::size_t begin = images.size();
  ASSERT_TRUE(spinUntil([&] { return images.size() >= begin + 20; }));
  const auto& messages = images.messages();
  EXPECT_NEAR((messages[begin + 15]->header.stamp - messages[begin + 5]->header.stamp).toSec(),
              10.0 / 60.0, 0.09);
  ASSERT_TRUE(spinUntil([&] { return infos.last()->width == 320; }));
  EXPECT_NEAR(infos.last()->K[0], 290.0, 0.01);
  EXPECT_NEAR(infos.last()->K[2], 159.5, 1e-9);

  // What the camera does not have is refused, and the images go on as they were.
  EXPECT_EQ(text(change("depth_mode", std::string("1280x1024@30")), "depth_mode"), "320x240@60");
  EXPECT_EQ(text(change("depth_mode", std::string("VGA")), "depth_mode"), "320x240@60");
  const std::size_t after = images.size();
  ASSERT_TRUE(spinUntil([&] { return images.size() >= after + 5; }));
  EXPECT_EQ(images.last()->width, 320U);
}

TEST_F(DriverParameterChange, RegisteredDepthHasTopicsOfItsOwn) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=VK2&noise=0"));
  Listener<sensor_msgs::Image> plain(node_, "depth/image_raw");
  Listener<sensor_msgs::Image> registered(node_, "depth_registered/image_raw");
  ASSERT_TRUE(spinUntil([&] { return plain.size() >= 3; }));
  EXPECT_EQ(registered.size(), 0U);
  change("depth_registration", true);
  ASSERT_TRUE(spinUntil([&] { return registered.size() >= 3; }));
  EXPECT_EQ(registered.last()->header.frame_id, "camera_rgb_optical_frame");
  const std::size_t begin = plain.size();
  const std::size_t more = registered.size() + 10;
  ASSERT_TRUE(spinUntil([&] { return registered.size() >= more; }));
  EXPECT_EQ(plain.size(), begin);
}

TEST_F(DriverParameterChange, DepthIsCorrected) {
  const std::string uri = "virtual://rubbish_bin?serial=VK3&noise=0";
  ASSERT_TRUE(manager_.loadDriver("/camera", uri));
  ASSERT_TRUE(manager_.loadDetection("/camera"));
  Listener<DominantPlane> planes(node_, "plane_detection/plane");
  ASSERT_TRUE(spinUntil([&] { return planes.size() >= 3; }));
  const double before = planes.last()->distance;
  EXPECT_NEAR(before, 0.45, 0.002);
  change("z_scale", 1.1);
  ASSERT_TRUE(spinUntil([&] { return std::abs(planes.last()->distance - 1.1 * before) < 0.002; }));
}

TEST_F(Driver, TellsItsSerialNumber) {
  ASSERT_TRUE(manager_.loadDriver("/camera", kUri));
  GetSerial call;
  ASSERT_TRUE(spinUntil([&] {
    return ros::service::call("/camera/get_serial", call) && !call.response.serial.empty();
  }));
  EXPECT_EQ(call.response.serial, "VK1");
}

}  // namespace
}  // namespace dominant_plane_detection
