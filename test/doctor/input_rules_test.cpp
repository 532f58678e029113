#include "doctor/input_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "doctor/stamp_offset.h"
#include "doctor/time_rules.h"
#include "support/finding.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kImage = "sensor_msgs/Image";
constexpr const char* kCloud = "sensor_msgs/PointCloud2";

/// A camera that does all that it should.
InputFacts healthy() {
  InputFacts input;
  input.depth = {"/camera/depth/image_raw", kImage, kImage, 100, {"/other/image"}};
  input.info = {"/camera/depth/camera_info",
                "sensor_msgs/CameraInfo",
                "sensor_msgs/CameraInfo",
                100,
                {"/other/camera_info"}};
  input.frame_id = "optical";
  input.encoding = "16UC1";
  input.width = 640;
  input.height = 480;
  input.camera = CameraInfoFacts{"optical", 640, 480, 525.0, 525.0, "K"};
  input.age = 0.05;
  return input;
}

TEST(InputRules, NothingIsWrongWithAHealthyCamera) {
  EXPECT_TRUE(examineInput(healthy()).empty());
  InputFacts recording = healthy();
  recording.live = false;
  EXPECT_TRUE(examineInput(recording).empty());
  InputFacts points;
  points.from_points = true;
  points.depth = {"/points", kCloud, kCloud, 3, {}};
  EXPECT_TRUE(examineInput(points).empty());
}

TEST(InputRules, NobodyPublishes) {
  InputFacts input = healthy();
  input.depth.messages = 0;
  input.depth.type = "";
  expectOnly(examineInput(input), Code::kNoImages,
             {"Nothing comes on /camera/depth/image_raw", "nobody publishes", "/other/image",
              "depth/image_raw:=/other/image"});
  input.depth.others.clear();
  expectOnly(examineInput(input), Code::kNoImages, {"Topics of this type: none", "camera.launch"});
}

TEST(InputRules, APublishedTopicIsSilent) {
  InputFacts input = healthy();
  input.depth.messages = 0;
  expectOnly(
      examineInput(input), Code::kNoImages,
      {"Nothing comes on /camera/depth/image_raw", "although it is published", "or is paused"});
}

TEST(InputRules, ARecordingHasNoDepth) {
  InputFacts input = healthy();
  input.live = false;
  input.depth = {"", kImage, "", 0, {"/rgb/image_raw (sensor_msgs/Image)"}};
  input.info = {};
  expectOnly(examineInput(input), Code::kNoImages,
             {"no depth image topic", "/rgb/image_raw", "record.launch"});
}

TEST(InputRules, ARecordingHasPackedDepth) {
  InputFacts input = healthy();
  input.live = false;
  input.depth = {"", kImage, "", 0, {}};
  input.depth.packed = "/camera/depth/image_raw/compressedDepth";
  const auto words = {"republish compressedDepth in:=/camera/depth/image_raw raw",
                      "and record /camera/depth/image_raw"};
  expectOnly(examineInput(input), Code::kNoImages, words);
  input.depth.name = input.depth.packed;
  input.depth.type = "sensor_msgs/CompressedImage";
  expectOnly(examineInput(input), Code::kTopicsSwapped, words);
}

TEST(InputRules, TheMasterIsAway) {
  InputFacts input = healthy();
  input.depth = {"/depth", kImage, "", 0, {}, false};
  expectOnly(examineInput(input), Code::kNoImages, {"the ROS master does not answer"});
  input.depth.messages = 1;
  input.info = {"/info", "sensor_msgs/CameraInfo", "", 0, {}, false};
  const Findings findings = examineInput(input);
  expectOnly(findings, Code::kNoCameraInfo);
  EXPECT_EQ(findings.front().text.find("nobody publishes"), std::string::npos);
}

TEST(InputRules, NothingIsSubscribed) {
  InputFacts input = healthy();
  input.depth.messages = 0;
  input.subscription_error = "Unable to load plugin for transport 'frob'";
  expectOnly(examineInput(input), Code::kUnusableImages, {"'frob'", "image_transport"});
}

TEST(InputRules, TopicsAreSwapped) {
  InputFacts input = healthy();
  input.depth.type = kCloud;
  input.depth.messages = 0;
  expectOnly(examineInput(input), Code::kTopicsSwapped,
             {kCloud, "is expected", "input to points", "points:=/camera/depth/image_raw"});
  input.from_points = true;
  input.depth.expected_type = kCloud;
  input.depth.type = kImage;
  expectOnly(examineInput(input), Code::kTopicsSwapped,
             {kImage, "input to depth", "depth/image_raw:=/camera/depth/image_raw"});
}

TEST(InputRules, AnotherTypeIsNeitherOfThem) {
  InputFacts input = healthy();
  input.depth.type = "sensor_msgs/CompressedImage";
  expectOnly(examineInput(input), Code::kTopicsSwapped,
             {"sensor_msgs/CompressedImage", "image_transport", "/other/image"});
}

TEST(InputRules, ThereIsNoCameraInfo) {
  InputFacts input = healthy();
  input.camera.reset();
  input.info.messages = 0;
  input.info.type = "";
  expectOnly(examineInput(input), Code::kNoCameraInfo,
             {"Images come on /camera/depth/image_raw, but no camera_info", "nobody publishes",
              "depth/camera_info:=/other/camera_info"});
  input.live = false;
  expectOnly(examineInput(input), Code::kNoCameraInfo, {"--camera FX,FY,CX,CY"});
}

TEST(InputRules, AnEncodingIsNoDepth) {
  InputFacts input = healthy();
  input.encoding_is_depth = false;
  input.refusal = "expected 16UC1, got 'rgb8'";
  input.camera->width = 320;  // nobody wants to hear of that as well
  expectOnly(examineInput(input), Code::kEncoding, {"got 'rgb8'", "depth/image_raw:=/other/image"});
}

TEST(InputRules, ACameraInfoIsNotCalibrated) {
  InputFacts input = healthy();
  input.refusal = "expected a calibrated camera_info";
  input.camera->fx = input.camera->fy = 0.0;
  input.camera->width = 0;  // neither is its size said
  expectOnly(examineInput(input), Code::kUncalibrated,
             {"0.0", " in K", "no calibration", "depth_camera_info_url"});
  input.camera->matrix = "P";
  expectOnly(examineInput(input), Code::kUncalibrated, {" in P", "rectified to false"});
}

TEST(InputRules, ACameraInfoIsOfAnotherSize) {
  InputFacts input = healthy();
  input.refusal = "expected a camera of the image's size";
  input.camera->width = 320;
  input.camera->height = 240;
  expectOnly(examineInput(input), Code::kCameraInfoSize,
             {"640 x 480", "320 x 240", "depth_camera_info_url of camera.launch", "binning",
              "the driver's parameter depth_mode"});
  input.camera->width = 640;
  expectOnly(examineInput(input), Code::kCameraInfoSize, {"640 x 240"});
  input.camera->width = 320;
  input.camera->height = 480;
  expectOnly(examineInput(input), Code::kCameraInfoSize, {"320 x 480"});
}

TEST(InputRules, StampsAreApart) {
  InputFacts input = healthy();
  input.info_offset = -0.0041;
  expectOnly(examineInput(input), Code::kStampsApart,
             {" is 4.1 ms off", "is used instead", "header.stamp"});
  input.camera->frame_id = "other";
  expectOnly(examineInput(input), Code::kStampsApart, {"'other'", "'optical'", "not used at all"});
}

TEST(InputRules, TheNearestStampIsThatOfAllThatCame) {
  EXPECT_FALSE(stampOffset({1.0, 2.0}, {}));
  EXPECT_FALSE(stampOffset({}, {1.0}));
  EXPECT_FALSE(stampOffset({1.0}, {1.0}));
  EXPECT_NEAR(*stampOffset({1.0, 1.1, 1.2}, {1.104, 1.004}), 0.004, 1e-9);
  EXPECT_NEAR(*stampOffset({1.0, 1.1}, {0.7, 1.07, 1.5}), -0.03, 1e-9);
  EXPECT_NEAR(std::abs(*stampOffset({1.0, 1.1, 1.2}, {1.1})), 0.1, 1e-9) << "one has its own";
  EXPECT_NEAR(*stampOffset({2.0}, {1.0, 1.5}), -0.5, 1e-9);
}

TEST(InputRules, WhatElseIsWrongWithImagesIsSaidInTheReadersWords) {
  InputFacts input = healthy();
  input.refusal = "expected at least 10 bytes of depth data, got 5";
  expectOnly(examineInput(input), Code::kUnusableImages, {"at least 10 bytes"});
}

TEST(InputRules, StampsAreOffTheClock) {
  InputFacts input = healthy();
  input.age = 12.0;
  expectOnly(examineInput(input), Code::kStampsOffClock, {"12.0 s after", "NTP", "time_offset"});
  input.age = -3.0;
  expectOnly(examineInput(input), Code::kStampsOffClock, {"3.0 s before", "NTP"});
  input.age = 1e8;
  expectOnly(examineInput(input), Code::kStampsOffClock, {"rosbag play --clock", "use_sim_time"});
  input.age = 1.0;
  EXPECT_TRUE(examineInput(input).empty());
  input.age = -0.1;
  EXPECT_TRUE(examineInput(input).empty());
  input.age = 1e8;
  input.live = false;
  EXPECT_TRUE(examineInput(input).empty()) << "a recording's age is not judged";
}

TEST(InputRules, SimulatedTimeNeedsAClock) {
  EXPECT_FALSE(findNoClock({false, false}));
  EXPECT_FALSE(findNoClock({false, true}));
  EXPECT_FALSE(findNoClock({true, true}));
  expectFinding(findNoClock({true, false}), Code::kNoClock,
                {"/use_sim_time", "rosbag play --clock", "rosparam set /use_sim_time false"});
}

TEST(Codes, AreUniqueAndAllInTheDocument) {
  std::ifstream file(DPD_SOURCE "/docs/doctor.md");
  const std::string document{std::istreambuf_iterator<char>(file), {}};
  std::set<std::string> seen;
  for (const char* name : kCodeNames) {
    EXPECT_TRUE(seen.insert(name).second) << name;
    EXPECT_NE(document.find("| `" + std::string(name) + "` |"), std::string::npos) << name;
  }
  EXPECT_EQ(asLine({Code::kMirrored, "text"}), "mirrored: text");
  EXPECT_STREQ(codeName(Code::kNoClock), "no-clock");
  EXPECT_EQ(inOneLine("Unable to load:\n-----\nno such - thing\n-----\n"),
            "Unable to load: no such - thing");
}

}  // namespace
}  // namespace dominant_plane_detection
