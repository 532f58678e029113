#include "openni2/camera_choice.h"

#include <gtest/gtest.h>

#include "openni2/video_mode.h"

namespace dominant_plane_detection {
namespace {

const std::vector<CameraDescription> kCameras = {
    {"1d27/0600@1/5", "PrimeSense", "PS1080", "1206120016"},
    {"1d27/0601@2/7", "PrimeSense", "PS1080", "1407210004"},
    {"freenect://0", "Microsoft", "Kinect", ""},
};

std::string uriOf(const std::string& id) { return chooseCamera(id, kCameras).uri; }
std::string errorOf(const std::string& id) { return chooseCamera(id, kCameras).error; }

TEST(CameraChoice, ByNumberSerialUriAndPartOfUri) {
  EXPECT_EQ(uriOf("#1"), kCameras[0].uri);
  EXPECT_EQ(uriOf("#3"), kCameras[2].uri);
  EXPECT_EQ(uriOf("1407210004"), kCameras[1].uri);
  EXPECT_EQ(uriOf("1d27/0600@1/5"), kCameras[0].uri);
  EXPECT_EQ(uriOf("@2/7"), kCameras[1].uri);
  EXPECT_EQ(uriOf("freenect"), kCameras[2].uri);
}

TEST(CameraChoice, NamesAVirtualDeviceOrAFileItself) {
  EXPECT_EQ(uriOf("virtual://rubbish_bin?serial=A"), "virtual://rubbish_bin?serial=A");
  EXPECT_TRUE(namesItself("virtual://x"));
  EXPECT_TRUE(namesItself("/x/y.oni"));
  EXPECT_FALSE(namesItself("#1"));
  EXPECT_FALSE(namesItself("1407210004"));
  EXPECT_EQ(errorOf("/no/such/file.oni"), "there is no file /no/such/file.oni");
}

TEST(CameraChoice, SaysWhatThereIsWhenItFails) {
  for (const std::string id : {"#4", "#0", "#x", "", "12345", "1d27"}) {
    const CameraChoice choice = chooseCamera(id, kCameras);
    EXPECT_EQ(choice.uri, "") << id;
    for (const CameraDescription& camera : kCameras) {
      EXPECT_NE(choice.error.find(camera.uri), std::string::npos) << choice.error;
    }
    EXPECT_NE(choice.error.find("1206120016"), std::string::npos) << choice.error;
  }
  EXPECT_NE(errorOf("1d27").find("'1d27' fits 2 cameras"), std::string::npos) << errorOf("1d27");
  EXPECT_EQ(chooseCamera("#1", {}).error, "there is no camera #1; no camera is connected");
}

TEST(CameraChoice, ASerialNumberIsTakenBeforeAPartOfAUri) {
  const std::vector<CameraDescription> cameras = {{"usb/77", "", "", "1"},
                                                  {"usb/78", "", "", "77"}};
  EXPECT_EQ(chooseCamera("77", cameras).uri, "usb/78");
}

TEST(VideoMode, TextBothWays) {
  const auto mode = parseVideoMode("320x240@60");
  ASSERT_TRUE(mode);
  EXPECT_EQ(*mode, (VideoMode{320, 240, 60}));
  EXPECT_EQ(toString(*mode), "320x240@60");
  for (const char* text : {"", "640x480", "640x480@", "640x480@30 ", "640*480@30", "0x480@30",
                           "640x480@-30", "x@", "99999999x1@1"}) {
    EXPECT_FALSE(parseVideoMode(text)) << text;
  }
}

}  // namespace
}  // namespace dominant_plane_detection
