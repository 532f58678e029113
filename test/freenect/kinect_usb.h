#pragma once

#include <dominant_plane_detection/GetSerial.h>

#include <string>

#include "freenect/freenect_double.h"
#include "openni2/camera_choice.h"
#include "support/driver_test.h"
#include "support/ros_test.h"

namespace dominant_plane_detection {

using freenect_double::Kinect;

/// A driver with Kinects of a libfreenect without USB, which are gone afterwards.
class KinectUsb : public testing::Test {
 protected:
  ~KinectUsb() override {
    for (const char* name : {"/camera/driver", "/other/driver"}) manager_.unload(name);
    for (const char* serial : {"A1", "A2"}) freenect_double::unplug(serial);
    // A nodelet may end in the thread that was its last, a moment after it was unloaded.
    EXPECT_TRUE(spinUntil([] { return freenect_double::open() == 0; }));
  }

  static std::string serial(const std::string& ns = "/camera") {
    GetSerial call;
    return ros::service::call(ns + "/get_serial", call) ? call.response.serial : "";
  }
  static bool listed(const std::string& serial) {
    const auto cameras = OpenNi2Runtime::instance()->cameras();
    return !chooseCamera(serial, cameras).uri.empty();
  }

  ros::NodeHandle node_{"/camera"};
  Manager manager_;
};

}  // namespace dominant_plane_detection
