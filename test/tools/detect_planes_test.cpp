// The command lines of detect_planes and render_scene, as users type them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/long_form.h"
#include "support/oni_recording.h"

namespace dominant_plane_detection {
namespace {

namespace fs = std::filesystem;
constexpr const char* kCamera = " --camera 580,580,319.5,239.5 ";

using Row = std::vector<std::string>;

/// @return rows by their first field; the header's is "frame".
std::map<std::string, Row> readCsv(const fs::path& file) {
  std::map<std::string, Row> rows;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    Row row{""};
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') {
        quoted = !quoted;
      } else if (c == ',' && !quoted) {
        row.emplace_back();
      } else {
        row.back() += c;
      }
    }
    rows[row.front()] = row;
  }
  return rows;
}

/// Two images of the bin scene as a folder and as a bag, rendered once.
class DetectPlanes : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = fs::temp_directory_path() / ("detect_planes_test_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    const std::string render =
        std::string(DPD_RENDER_SCENE) + " " + DPD_SOURCE +
        "/scenes/rubbish_bin.yaml --sensor independent --rate 1 --duration 1 "
        "--output ";
    ASSERT_EQ(run(render + (folder_ / "images").string()).status, 0);
    ASSERT_EQ(run(render + (folder_ / "drive.bag").string()).status, 0);
  }
  static void TearDownTestSuite() { fs::remove_all(folder_); }

  static std::string path(const std::string& name) { return (folder_ / name).string(); }
  /// Runs detect_planes with its output in a new folder `out`.
  static Outcome detect(const std::string& arguments) {
    fs::remove_all(folder_ / "out");
    return run(std::string(DPD_DETECT_PLANES) + " --output " + path("out") + " " + arguments);
  }
  static std::map<std::string, Row> planes() { return readCsv(folder_ / "out" / "planes.csv"); }

  static void expectTruth(const Row& row) {
    ASSERT_EQ(row.size(), 11U);
    EXPECT_EQ(row[1], "FOUND");
    EXPECT_EQ(row[9], "");
    EXPECT_NEAR(std::stod(row[3]), -std::cos(0.22), 0.002);
    EXPECT_NEAR(std::stod(row[4]), -std::sin(0.22), 0.002);
    EXPECT_NEAR(std::stod(row[5]), 0.45, 0.002);
    EXPECT_GT(std::stoi(row[7]), 100000);
    std::istringstream covariance(row[10]);
    const std::vector<double> numbers{std::istream_iterator<double>(covariance), {}};
    ASSERT_EQ(numbers.size(), 16U) << row[10];
    EXPECT_GT(numbers[15], 0.0);
    EXPECT_EQ(numbers[7], numbers[13]) << "of a normal's y and the distance";
  }

  static fs::path folder_;
};
fs::path DetectPlanes::folder_;

TEST_F(DetectPlanes, FolderOfPngFiles) {
  const Outcome outcome = detect(path("images/depth") + kCamera);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("2 images, 2 FOUND"), std::string::npos) << outcome.text;
  const auto rows = planes();
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows.at("frame"), (Row{"frame", "state", "normal_x", "normal_y", "normal_z", "distance",
                                   "mse", "inliers", "ms", "reason", "covariance"}));
  expectTruth(rows.at("0000"));
  expectTruth(rows.at("0001"));
  const cv::Mat mask = cv::imread(path("out/masks/0001.png"), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(mask.type(), CV_8UC1);
  EXPECT_EQ(cv::countNonZero(mask), std::stoi(rows.at("0001")[7]));
  EXPECT_EQ(mask.at<std::uint8_t>(470, 320), 255);
  const cv::Mat overlay = cv::imread(path("out/overlays/0001.png"), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(overlay.type(), CV_8UC3);
  EXPECT_EQ(overlay.at<cv::Vec3b>(470, 320), cv::Vec3b(0, 0, 0));
}

TEST_F(DetectPlanes, Bag) {
  const Outcome outcome = detect(path("drive.bag"));
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  const auto rows = planes();
  ASSERT_EQ(rows.size(), 3U);
  expectTruth(rows.at("1600000000.000000000"));
  expectTruth(rows.at("1600000001.000000000"));
  EXPECT_TRUE(fs::exists(path("out/masks/1600000001.000000000.png")));
  const Outcome topic = detect(path("drive.bag") + " --topic /nothing");
  EXPECT_EQ(topic.status, 1);
  EXPECT_NE(topic.text.find("/camera/depth/image_raw"), std::string::npos) << topic.text;
}

TEST_F(DetectPlanes, OniRecording) {
  recordOni("virtual://rubbish_bin?serial=TOOL&sensor=independent", path("drive.oni"), 6);
  const Outcome outcome = detect(path("drive.oni"));
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  const auto rows = planes();
  ASSERT_GE(rows.size(), 4U);
  EXPECT_EQ(rows.count("0.000000000"), 1U) << "named by the recording's own time";
  for (const auto& [frame, row] : rows) {
    if (frame != "frame") expectTruth(row);
  }
  // The camera comes from the recorded field of view, unless it is given.
  ASSERT_EQ(detect(path("drive.oni") + " --camera 290,290,319.5,239.5").status, 0);
  EXPECT_NE(planes().begin()->second[5], rows.begin()->second[5]);

  std::ofstream(path("broken.oni")) << "no recording";
  const Outcome broken = detect(path("broken.oni"));
  EXPECT_EQ(broken.status, 1);
  EXPECT_NE(broken.text.find("broken.oni"), std::string::npos) << broken.text;
}

/// OpenNI2's player used to crash once in 150 times when its stream was destroyed.
TEST_F(DetectPlanes, OniRecordingIsClosedWithoutACrash) {
  recordOni("virtual://rubbish_bin?serial=CLOSE&noise=0", path("close.oni"), 3);
  for (int i = 0; i < longForm(3, 600); ++i) {
    const Outcome outcome = detect(path("close.oni"));
    ASSERT_EQ(outcome.status, 0) << "run " << i << ": " << outcome.text;
  }
}

/// One bit of the frames' size: OpenNI2 gives less than the images that it speaks of.
TEST_F(DetectPlanes, OniRecordingWithFramesThatAreTooShort) {
  recordOni("virtual://rubbish_bin?serial=SHORT&noise=0", path("short.oni"), 3);
  // 640 * 480 * 2 = 0x96000 becomes 0x16000.
  ASSERT_EQ(flipBit(path("short.oni"), "oniRequiredFrameSize", 27, 3), 0x09);
  const Outcome outcome = detect(path("short.oni"));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.text.find("expected 614400 byte of depth, got 90112"), std::string::npos)
      << outcome.text;
}

TEST(ListDevices, ShowsWhatADeviceCanDo) {
  const Outcome outcome =
      run(std::string(DPD_LIST_DEVICES) + " 'virtual://laboratory?serial=LIST'");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.text.find("serial number LIST"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("depth: 640x480@30, 320x240@60, 320x240@30"), std::string::npos);
  const Outcome wrong = run(std::string(DPD_LIST_DEVICES) + " '#99'");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_NE(wrong.text.find("there is no camera #99"), std::string::npos) << wrong.text;
}

TEST(ListDevices, SaysThatAnotherOpenNI2WasLoadedFirst) {
  const Outcome outcome =
      run(std::string("LD_PRELOAD=") + DPD_SYSTEM_OPENNI2 + " " + DPD_LIST_DEVICES);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.text.find("expected OpenNI2 from the folder dominant_plane_detection/openni2"),
            std::string::npos)
      << outcome.text;
}

TEST_F(DetectPlanes, BothAlgorithmsAgree) {
  const Outcome outcome = detect(path("images/depth/0000.png") + kCamera + "--algorithm kdtree");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  expectTruth(planes().at("0000"));
}

TEST_F(DetectPlanes, WhatCannotBeReadIsNamedAndTheRestProcessed) {
  std::ofstream(path("broken.png")) << "no picture";
  std::ofstream(path("broken.bag")) << "no bag";
  cv::imwrite(path("colour.png"), cv::Mat(480, 640, CV_8UC3, cv::Scalar(1, 2, 3)));
  const Outcome outcome =
      detect(path("broken.png") + " " + path("colour.png") + " " + path("broken.bag") + " " +
             path("missing.png") + " " + path("images/depth/0000.png") + kCamera);
  EXPECT_EQ(outcome.status, 1);
  for (const char* name : {"broken.png", "colour.png", "broken.bag", "missing.png"}) {
    EXPECT_NE(outcome.text.find(name), std::string::npos) << name << " in " << outcome.text;
  }
  const auto rows = planes();
  ASSERT_EQ(rows.size(), 2U);
  expectTruth(rows.at("0000"));
}

/// The bin's scene with a wall behind it.
TEST_F(DetectPlanes, FurtherPlanesHaveATableOfTheirOwn) {
  ASSERT_EQ(detect(path("images/depth") + kCamera).status, 0);
  EXPECT_FALSE(fs::exists(path("out/planes_more.csv")));
  ASSERT_EQ(detect(path("images/depth") + kCamera + " --set max_planes=4").status, 0);
  std::ifstream table(path("out/planes_more.csv"));
  std::string line;
  ASSERT_TRUE(std::getline(table, line));
  EXPECT_EQ(line, "frame,rank,normal_x,normal_y,normal_z,distance,inliers,kind");
  ASSERT_TRUE(std::getline(table, line));
  EXPECT_EQ(line.rfind("0000,2,", 0), 0U) << line;
  EXPECT_NE(line.find(",wall"), std::string::npos) << line;
}

TEST_F(DetectPlanes, AnImageWithoutAPlaneHasItsRowAndABlackMask) {
  cv::imwrite(path("empty.png"), cv::Mat(480, 640, CV_16UC1, cv::Scalar(0)));
  const Outcome outcome = detect(path("empty.png") + kCamera);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  const Row row = planes().at("empty");
  ASSERT_EQ(row.size(), 11U);
  EXPECT_NE(row[9].find("There are no readings at all"), std::string::npos) << row[9];
  EXPECT_EQ(row[1], "NO_DEPTH");
  for (int i = 2; i <= 6; ++i) EXPECT_EQ(row[static_cast<std::size_t>(i)], "");
  EXPECT_EQ(row[7], "0");
  const cv::Mat mask = cv::imread(path("out/masks/empty.png"), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(mask.size(), cv::Size(640, 480));
  EXPECT_EQ(cv::countNonZero(mask), 0);
}

/// Fifths of a millimetre taken for millimetres: nothing is in range, and that is said.
TEST_F(DetectPlanes, AWrongDepthScaleIsToldByWhatTheDepthsLookLike) {
  cv::Mat depth = cv::imread(path("images/depth/0000.png"), cv::IMREAD_UNCHANGED);
  depth = depth * 5 + 4500;
  cv::imwrite(path("fifths.png"), depth);
  const Outcome outcome = detect(path("fifths.png") + kCamera);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.text.find("1 images, 1 NO_DEPTH"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("between 0.50 and 4.00 m"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("is --depth-scale right"), std::string::npos) << outcome.text;
  const std::string reason = planes().at("fifths")[9];
  double near = 0.0, far = 0.0;
  ASSERT_EQ(std::sscanf(reason.c_str() + reason.find("Nine"),
                        "Nine of ten readings are from %lf to %lf m", &near, &far),
            2)
      << reason;
  EXPECT_GT(near, 4.0);
  EXPECT_LT(near, far);
  EXPECT_LT(far, 65.6);
}

TEST_F(DetectPlanes, EqualStemsGetTheirFoldersNames) {
  fs::create_directories(folder_ / "second");
  fs::copy_file(path("images/depth/0000.png"), path("second/0000.png"),
                fs::copy_options::overwrite_existing);
  EXPECT_EQ(detect(path("images/depth/0000.png") + " " + path("second") + kCamera).status, 0);
  const auto rows = planes();
  EXPECT_EQ(rows.count("depth_0000"), 1U);
  EXPECT_EQ(rows.count("second_0000"), 1U);
}

TEST_F(DetectPlanes, ParametersFromFileAndCommandLine) {
  std::ofstream(path("p.yaml")) << "range_max: 1.0\ninput: depth\n";
  const std::string image = path("images/depth/0000.png") + kCamera;
  EXPECT_EQ(detect(image).status, 0);
  const int all = std::stoi(planes().at("0000")[7]);
  EXPECT_EQ(detect(image + "--params " + path("p.yaml")).status, 0);
  const int near = std::stoi(planes().at("0000")[7]);
  EXPECT_LT(near, all / 2);
  EXPECT_EQ(detect(image + "--params " + path("p.yaml") + " --range 0.5,4.0").status, 0);
  EXPECT_EQ(std::stoi(planes().at("0000")[7]), all);
  EXPECT_EQ(detect(image + "--set range_max=1.0 --set seeds=9").status, 0);
  EXPECT_EQ(std::stoi(planes().at("0000")[7]), near);
}

TEST_F(DetectPlanes, LabelsAreWrittenWhenAskedFor) {
  const std::string image = path("images/depth/0000.png") + kCamera;
  EXPECT_EQ(detect(image).status, 0);
  EXPECT_FALSE(fs::exists(path("out/labels")));
  EXPECT_EQ(detect(image + "--labels").status, 0);
  const cv::Mat labels = cv::imread(path("out/labels/0000.png"), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(labels.type(), CV_8UC1);
  const cv::Mat mask = cv::imread(path("out/masks/0000.png"), cv::IMREAD_UNCHANGED);
  EXPECT_EQ(cv::countNonZero((labels == 1) != mask), 0);
  EXPECT_EQ(labels.at<std::uint8_t>(470, 320), 1);
  EXPECT_GT(cv::countNonZero(labels == 2), 10000) << "the bin";
}

/// A profile is found by its name from wherever the program is started, and before --set.
TEST_F(DetectPlanes, SensorProfilesByNameAndByFile) {
  const std::string image = path("images/depth/0000.png") + kCamera;
  const auto inliers = [&](const std::string& arguments) {
    const Outcome outcome = detect(image + arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return planes().at("0000")[7];
  };
  const std::string generic = inliers("");
  EXPECT_EQ(inliers("--sensor generic"), generic);
  for (const char* name : {"kinect_v1", "realsense_d4xx", "xtion"}) {
    EXPECT_EQ(detect(image + "--sensor " + name).status, 0) << name;
  }
  std::ofstream(path("mine.yaml")) << "range_max: 1.0\n";
  EXPECT_EQ(inliers("--sensor " + path("mine.yaml")), inliers("--range 0.5,1.0"));
  EXPECT_EQ(inliers("--sensor " + path("mine.yaml") + " --set range_max=4.0"), generic);
  const Outcome wrong = detect(image + "--sensor kinect");
  EXPECT_NE(wrong.status, 0);
  EXPECT_NE(wrong.text.find("generic, kinect_v1, realsense_d4xx, xtion"), std::string::npos)
      << wrong.text;
}

TEST_F(DetectPlanes, UsageErrorsSayWhatWasExpected) {
  const std::string image = path("images/depth/0000.png") + " ";
  const auto expectError = [&](const std::string& arguments, const char* words) {
    const Outcome outcome = detect(arguments);
    EXPECT_NE(outcome.status, 0) << arguments;
    EXPECT_NE(outcome.text.find(words), std::string::npos) << outcome.text;
  };
  expectError(image, "--camera FX,FY,CX,CY");
  expectError(image + "--camera 1,2,3", "--camera");
  expectError(image + kCamera + "--set nonsense=1", "there is no parameter 'nonsense'");
  expectError(image + kCamera + "--set range_max", "NAME=VALUE");
  expectError(image + kCamera + "--range 4,1", "range_min has to be smaller than range_max");
  expectError(image + kCamera + "--params " + path("missing.yaml"), "missing.yaml");
  expectError(image + "--camera-info " + path("missing.yaml"), "missing.yaml");
  expectError(image + kCamera + "--depth-scale -5", "--depth-scale");
  const Outcome help = run(std::string(DPD_DETECT_PLANES) + " --help");
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.text.find("--depth-scale"), std::string::npos);
}

TEST_F(DetectPlanes, CameraInfoFile) {
  std::ofstream(path("camera.yaml"))
      << "image_width: 640\nimage_height: 480\ncamera_name: kinect\n"
         "camera_matrix: {rows: 3, cols: 3, data: [580, 0, 319.5, 0, 580, 239.5, 0, 0, 1]}\n"
         "distortion_model: plumb_bob\n"
         "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"
         "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n"
         "projection_matrix: {rows: 3, cols: 4, data: [580, 0, 319.5, 0, 0, 580, 239.5, 0, 0, 0, "
         "1, "
         "0]}\n";
  EXPECT_EQ(detect(path("images/depth/0000.png") + " --camera-info " + path("camera.yaml")).status,
            0);
  expectTruth(planes().at("0000"));
}

}  // namespace
}  // namespace dominant_plane_detection
