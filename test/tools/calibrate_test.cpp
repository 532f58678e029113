// The command lines of calibrate_depth and calibrate_mount, as users type them.

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Image.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <regex>

#include "calibration/depth_calibration_file.h"
#include "calibration/pair_file.h"
#include "support/command.h"
#include "support/oni_recording.h"
#include "support/recordings.h"
#include "tools/yaml_files.h"

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;

class Calibrate : public testing::Test {
 protected:
  Calibrate()
      : folder_(fs::temp_directory_path() / ("calibrate_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Calibrate() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static Outcome depth(const std::string& arguments) {
    return run(std::string(DPD_CALIBRATE_DEPTH) + " " + arguments);
  }
  static Outcome mount(const std::string& arguments) {
    return run(std::string(DPD_CALIBRATE_MOUNT) + " " + arguments);
  }

  /// A wall in front of a virtual Kinect, and perhaps a post before it. @return its URI.
  std::string wallAt(double distance, bool post = false) const {
    const std::string file = path("wall_" + std::to_string(distance) + ".yaml");
    std::ofstream(file) << "camera: {width: 640, height: 480, fx: 575.8, fy: 575.8, cx: 319.5, cy: "
                           "239.5}\nnoise: {sensor: independent}\npath:\n  - {time: 0, position: "
                           "[0, 0, 1]}\nobjects:\n"
                           "  - {shape: wall, size: [0.1, 10, 4], position: ["
                        << distance + 0.05 << ", 0, 0]}\n";
    if (post) {
      std::ofstream(file, std::ios::app)
          << "  - {shape: box, size: [0.1, 0.1, 2], position: [" << distance - 0.3 << ", 0, 0]}\n";
    }
    return "virtual://" + file + "?serial=WALL";
  }

  fs::path folder_;
};

/// @return the number that a pattern's group matches; NaN when it does not.
double numberIn(const std::string& text, const std::string& pattern) {
  std::smatch match;
  return std::regex_search(text, match, std::regex(pattern)) ? std::stod(match[1]) : NAN;
}

std::size_t pixelsOfColour(const cv::Mat& picture, int first_row, int last_row, bool grey) {
  std::size_t count = 0;
  for (int v = first_row; v < last_row; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const auto& p = picture.at<cv::Vec3b>(v, u);
      const int spread = std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]});
      count += (spread < 60) == grey && p != cv::Vec3b(255, 255, 255) ? 1U : 0U;
    }
  }
  return count;
}

TEST_F(Calibrate, FitsPairsOfAFileAndDrawsThem) {
  const DepthCalibration truth = DepthCalibration::paper();
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, 0.003);
  for (int raw = 40; raw <= 2000; raw += raw < 200 ? 10 : 100) {
    appendPair(path("pairs.csv"), {1.0 * raw, truth.evaluate(raw) + noise(generator), 0.0});
  }
  const Outcome outcome = depth("fit " + path("pairs.csv") + " --form exponential --output " +
                                path("fit.yaml") + " --plot " + path("fit.png"));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const std::string number = " = (\\S+) \\+- ";
  const double error_a = numberIn(outcome.text, "a = \\S+ \\+- (\\S+) m");
  EXPECT_NEAR(numberIn(outcome.text, "a" + number), truth.a, 3.0 * error_a);
  EXPECT_LT(error_a, 0.01);
  const DepthCalibration fitted = loadDepthCalibration(path("fit.yaml"));
  EXPECT_EQ(fitted.form, DepthCalibration::Form::kExponential);
  for (int raw = 50; raw <= 2000; raw += 50) {
    EXPECT_NEAR(fitted.evaluate(raw), truth.evaluate(raw), 0.01) << raw;
  }
  const cv::Mat picture = cv::imread(path("fit.png"));
  ASSERT_EQ(picture.size(), cv::Size(900, 900));
  EXPECT_GT(pixelsOfColour(picture, 0, 450, false), 1000U) << "curve and points";
  EXPECT_GT(pixelsOfColour(picture, 450, 900, false), 200U) << "residuals";
  EXPECT_GT(pixelsOfColour(picture, 0, 900, true), 2000U) << "axes and text";
}

TEST_F(Calibrate, AFileOfWrongPairsIsExplained) {
  const auto problem = [&](const std::string& text) {
    std::ofstream(path("wrong.csv")) << text;
    const Outcome outcome = depth("fit " + path("wrong.csv") + " --output " + path("none.yaml"));
    EXPECT_EQ(outcome.status, 1) << text;
    EXPECT_NE(outcome.text.find("wrong.csv"), std::string::npos) << outcome.text;
    EXPECT_FALSE(fs::exists(path("none.yaml")));
    return outcome.text;
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(problem("raw,distance\n500,0.56\n600,0.67\n"), "too few pairs"));
  EXPECT_TRUE(has(problem("raw,distance\n500,3\n600,2\n700,1.5\n800,1\n"), "not monotonic"));
  EXPECT_TRUE(has(problem("raw,depth\n500,0.56\n600,0.67\n"), "columns raw,distance"));
  EXPECT_TRUE(has(problem("500,0.56\n600,0.67\n"), "columns raw,distance"));
  EXPECT_TRUE(has(problem("raw\n500\n600\n"), "columns raw,distance"));
  EXPECT_TRUE(has(problem("raw,distance\n500,0.56\n600\n700,0.85\n"), "line"));
  EXPECT_TRUE(has(problem("raw,distance\n500,0.56\n600,far\n700,0.85\n"), "far"));
  EXPECT_TRUE(has(problem(""), "columns raw,distance"));
  const Outcome missing = depth("fit " + path("no.csv"));
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.text.find("no.csv"), std::string::npos) << missing.text;
  EXPECT_NE(depth("").status, 0) << "fit or measure";
}

TEST_F(Calibrate, MeasuresWallsWithACameraAndFindsItsCalibration) {
  for (const double distance : {0.6, 0.8, 1.1, 1.5, 2.0, 2.6, 3.3}) {
    const Outcome outcome =
        depth("measure --device '" + wallAt(distance) + "' --frames 10 --distance " +
              std::to_string(distance) + " --output " + path("pairs.csv"));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
  }
  const auto pairs = loadPairs(path("pairs.csv"));
  ASSERT_EQ(pairs.size(), 7U);
  const Outcome outcome = depth("fit " + path("pairs.csv") + " --output " + path("fit.yaml"));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const DepthCalibration fitted = loadDepthCalibration(path("fit.yaml"));
  const DepthCalibration truth = DepthCalibration::kinect();
  for (int raw = 500; raw <= 980; raw += 20) {
    EXPECT_NEAR(fitted.evaluate(raw), truth.evaluate(raw), 0.002 * truth.evaluate(raw)) << raw;
  }
}

TEST_F(Calibrate, AnApostropheInThePicturesNameIsNoMatter) {
  const DepthCalibration truth = DepthCalibration::kinect();
  for (int raw = 500; raw <= 900; raw += 50) {
    appendPair(path("pairs.csv"), {1.0 * raw, truth.evaluate(raw)});
  }
  const std::string picture = path("anne's 'fit'.png");
  const Outcome outcome = depth("fit " + path("pairs.csv") + " --plot \"" + picture + "\"");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_FALSE(cv::imread(picture).empty());
}

TEST_F(Calibrate, AsksForDistancesUntilAnEmptyLine) {
  const Outcome outcome =
      run("printf '1.2\\nfar\\n1.2\\n\\n' | " DPD_CALIBRATE_DEPTH " measure --frames 3 --device '" +
          wallAt(1.2) + "' --output " + path("pairs.csv"));
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("got 'far'"), std::string::npos) << outcome.text;
  const auto pairs = loadPairs(path("pairs.csv"));
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_NEAR(DepthCalibration::kinect().evaluate(pairs[0].raw), 1.2, 0.002);
}

TEST_F(Calibrate, MeasuresRecordingsOfAllKinds) {
  fs::create_directories(path("png"));
  const auto frames = recordOni(wallAt(1.4), path("wall.oni"), 5, openni::PIXEL_FORMAT_SHIFT_9_2);
  rosbag::Bag bag(path("wall.bag"), rosbag::bagmode::Write);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const cv::Mat image(480, 640, CV_16UC1, const_cast<std::uint16_t*>(frames[i].data()));
    cv::imwrite(path("png/" + std::to_string(i) + ".png"), image);
    sensor_msgs::Image message;
    message.encoding = "16UC1";
    message.width = 640;
    message.height = 480;
    message.step = 1280;
    message.header.stamp = ros::Time(100.0 + 0.1 * static_cast<double>(i));
    message.data.assign(image.data, image.data + 1280 * 480);
    bag.write("/camera/depth/disparity_raw", message.header.stamp, message);
  }
  bag.close();
  for (const char* input : {"wall.oni", "wall.bag", "png"}) {
    const Outcome outcome = depth("measure " + path(input) + " --distance 1.4 --output " +
                                  path(std::string(input) + ".csv"));
    ASSERT_EQ(outcome.status, 0) << input << ": " << outcome.text;
    const auto pairs = loadPairs(path(std::string(input) + ".csv"));
    ASSERT_EQ(pairs.size(), 1U);
    EXPECT_EQ(pairs[0].distance, 1.4);
    EXPECT_NEAR(DepthCalibration::kinect().evaluate(pairs[0].raw), 1.4, 0.003) << input;
  }
}

TEST_F(Calibrate, WhatIsNoWallIsExplainedAndNotRecorded) {
  const std::string output = " --output " + path("pairs.csv");
  const Outcome post = depth("measure --device '" + wallAt(1.4, true) + "' --distance 1" + output);
  EXPECT_EQ(post.status, 1);
  EXPECT_NE(post.text.find("flat wall"), std::string::npos) << post.text;
  const Outcome none = depth("measure --distance 1" + output);
  EXPECT_EQ(none.status, 1);
  EXPECT_NE(none.text.find("--device"), std::string::npos) << none.text;
  const Outcome no_camera = depth("measure --device nobody --distance 1" + output);
  EXPECT_EQ(no_camera.status, 1);
  EXPECT_NE(no_camera.text.find("nobody"), std::string::npos) << no_camera.text;
  recordOni(wallAt(1.4), path("mm.oni"), 2);
  const Outcome millimetres = depth("measure " + path("mm.oni") + " --distance 1.4" + output);
  EXPECT_EQ(millimetres.status, 1);
  EXPECT_NE(millimetres.text.find("raw disparity"), std::string::npos) << millimetres.text;
  EXPECT_FALSE(fs::exists(path("pairs.csv")));
}

TEST_F(Calibrate, MountOfARecordedCamera) {
  ASSERT_EQ(run(std::string(DPD_RENDER_SCENE) +
                " " DPD_SOURCE
                "/scenes/rubbish_bin.yaml --sensor independent --rate 10 --duration 2 --output " +
                path("drive.bag"))
                .status,
            0);
  const Outcome outcome = mount(path("drive.bag"));
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NEAR(numberIn(outcome.text, "height (\\S+) m"), 0.45, 0.001);
  EXPECT_NEAR(numberIn(outcome.text, "pitch .*\\((\\S+) rad"), 0.22, 0.001);
  EXPECT_NEAR(numberIn(outcome.text, "roll .*\\((\\S+) rad"), 0.0, 0.001);
  EXPECT_NE(outcome.text.find("mount_height:=0.45"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("static_transform_publisher"), std::string::npos) << outcome.text;
}

TEST_F(Calibrate, ACameraInTheHandHasNoMount) {
  ASSERT_EQ(run(std::string(DPD_RENDER_SCENE) +
                " " DPD_SOURCE "/scenes/laboratory.yaml --rate 5 --duration 6 --output " +
                path("hand.bag"))
                .status,
            0);
  const Outcome outcome = mount(path("hand.bag"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.text.find("moves"), std::string::npos) << outcome.text;
}

TEST_F(Calibrate, MountOfTheRobotLabRecording) {
  const std::string bag = recordingsFolder() + "/robot_lab.bag";
  if (!fs::exists(bag)) GTEST_SKIP() << "no " << bag;
  const Outcome outcome = mount(bag);
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  std::cout << outcome.text;
  EXPECT_NEAR(numberIn(outcome.text, "height (\\S+) m"), 0.631, 0.005);
  EXPECT_LT(numberIn(outcome.text, "height \\S+ m \\+- (\\S+) m"), 0.002);
}

/// Eq. 2 and 3 with the numbers of Table I, for the file that ships.
TEST(PaperCameraInfo, IsTableIByEquations2And3) {
  const CameraModel camera = loadCamera(DPD_SOURCE "/config/paper_camera_info.yaml");
  const double f = 4.98, rho = 7.8e-3, x0 = 2.76, y0 = 2.26;  // [mm]
  const double delta_x = 5.994e-3, delta_y = -7.027e-4;       // [mm]
  const double z = 1.7;                                       // [m]
  for (const double u : {0.0, 100.5, 639.0}) {
    for (const double v : {0.0, 300.25, 479.0}) {
      const double x = -(z / f) * (u * rho - x0 + delta_x);  // Eq. 2
      const double y = -(z / f) * (v * rho - y0 + delta_y);  // Eq. 3
      const Eigen::Vector2d ray = camera.ray({u, v});
      EXPECT_NEAR(z * ray.x(), -x, 1e-9);  // the paper's frame is turned by pi about the axis
      EXPECT_NEAR(z * ray.y(), -y, 1e-9);
    }
  }
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_TRUE(camera.coefficients == paperCamera().coefficients);
}

}  // namespace
}  // namespace dominant_plane_detection
