// calibrate_mount asked of a detection nodelet, by service and by command.

#include <dominant_plane_detection/CalibrateMount.h>
#include <dominant_plane_detection/DominantPlane.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <atomic>
#include <future>

#include "support/command.h"
#include "support/driver_test.h"
#include "support/long_form.h"
#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kService = "/camera/plane_detection/calibrate_mount";

class MountService : public testing::Test {
 protected:
  void start(const std::string& uri) {
    ASSERT_TRUE(manager_.loadDriver("/camera", uri));
    ASSERT_TRUE(manager_.loadDetection("/camera"));
    ASSERT_TRUE(ros::service::waitForService(kService, 10000));
  }
  static CalibrateMount::Response call(std::uint32_t frames) {
    CalibrateMount call;
    call.request.frames = frames;
    EXPECT_TRUE(ros::service::call(kService, call));
    return call.response;
  }

  Manager manager_;
};

TEST_F(MountService, GivesTheScenesMountWithoutAnyOtherListener) {
  start("virtual://rubbish_bin?serial=M1&sensor=independent");
  const auto mount = call(40);
  ASSERT_TRUE(mount.success) << mount.message;
  EXPECT_EQ(mount.frames, 40U);
  EXPECT_NEAR(mount.height, 0.45, 0.001);
  EXPECT_NEAR(mount.pitch, 0.22, 0.001);
  EXPECT_NEAR(mount.roll, 0.0, 0.001);
  EXPECT_LT(mount.height_error, 0.0005);
  EXPECT_NE(mount.launch.find("mount_pitch:=0.22"), std::string::npos) << mount.launch;
  // And again, by the command.
  const Outcome outcome = run(std::string(DPD_CALIBRATE_MOUNT) + " --frames 20");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("height 0.45"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("from 20 images"), std::string::npos) << outcome.text;
}

/// Unsubscribing waited for a callback that waited for the lock that it held.
TEST_F(MountService, CallsEndWhileListenersComeAndGo) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=M5&sensor=independent",
                                  {{"depth_mode", "320x240@60"}}));
  ASSERT_TRUE(manager_.loadDetection("/camera"));
  ASSERT_TRUE(ros::service::waitForService(kService, 10000));
  const int calls = longForm(20, 1000);
  std::atomic<int> answered{0};
  auto caller = std::async(std::launch::async, [&] {
    int successes = 0;
    for (int i = 0; i < calls; ++i, ++answered) successes += call(10).success ? 1 : 0;
    return successes;
  });
  ros::NodeHandle node("/camera/plane_detection");
  std::size_t planes = 0;
  for (int last = -1; last < calls;) {
    Listener<DominantPlane> plane(node, "plane");
    ASSERT_TRUE(spinUntil([&] { return plane.size() > 0; })) << "after " << answered << " calls";
    Listener<sensor_msgs::Image> overlay(node, "overlay");
    Listener<sensor_msgs::PointCloud2> cloud(node, "ground");
    ASSERT_TRUE(spinUntil([&] { return overlay.size() > 0 && cloud.size() > 0; }))
        << "after " << answered << " calls";
    planes += plane.size();
    last = answered;
  }
  ASSERT_TRUE(spinUntil([&] { return isReady(caller); }));
  EXPECT_EQ(caller.get(), calls);
  std::cout << calls << " calls, " << planes << " planes meanwhile\n";
}

TEST_F(MountService, RefusesMoreFramesThanAnybodyWaitsFor) {
  start("virtual://rubbish_bin?serial=M6");
  const auto mount = call(4294967295U);
  EXPECT_FALSE(mount.success);
  EXPECT_NE(mount.message.find("at most 10000 frames"), std::string::npos) << mount.message;
}

TEST_F(MountService, RefusesACameraThatMoves) {
  start("virtual://laboratory?serial=M2");
  const auto mount = call(60);
  EXPECT_FALSE(mount.success);
  EXPECT_NE(mount.message.find("moves"), std::string::npos) << mount.message;
  const Outcome outcome = run(std::string(DPD_CALIBRATE_MOUNT) + " --frames 60");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.text.find("moves"), std::string::npos) << outcome.text;
}

TEST_F(MountService, SaysWhenNoImagesCome) {
  start("nobody");
  const auto mount = call(20);
  EXPECT_FALSE(mount.success);
  EXPECT_NE(mount.message.find("expected 20 images, got 0"), std::string::npos) << mount.message;
  const Outcome outcome = run(std::string(DPD_CALIBRATE_MOUNT) + " --node /nobody");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.text.find("/nobody/calibrate_mount"), std::string::npos) << outcome.text;
}

TEST_F(MountService, EndsWithItsNodelet) {
  start("virtual://rubbish_bin?serial=M3");
  ros::NodeHandle node("/camera");
  auto answer = std::async(std::launch::async, [] {
    CalibrateMount call;
    call.request.frames = 10000;
    return ros::service::call(kService, call) ? call.response.message : "no answer";
  });
  // The call has begun when the detection has subscribed the images.
  const auto listeners = [&] {
    XmlRpc::XmlRpcValue request, response, payload;
    request[0] = ros::this_node::getName();
    ros::master::execute("getSystemState", request, response, payload, false);
    for (int i = 0; i < payload[1].size(); ++i) {
      if (std::string(payload[1][i][0]) == "/camera/depth/image_raw") return true;
    }
    return false;
  };
  ASSERT_TRUE(spinUntil(listeners));
  ASSERT_TRUE(manager_.unload("/camera/plane_detection"));
  ASSERT_TRUE(spinUntil([&] { return isReady(answer); }, 10.0));
  EXPECT_NE(answer.get(), "");
}

}  // namespace
}  // namespace dominant_plane_detection
