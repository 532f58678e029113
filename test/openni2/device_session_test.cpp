// The session that keeps a camera, without ROS around it.

#include "openni2/device_session.h"

#include <gtest/gtest.h>

#include <future>

namespace dominant_plane_detection {
namespace {

constexpr std::chrono::seconds kLong{20};

/// Whoever takes a depth image holds up depth, and nothing else.
TEST(DeviceSession, ASlowReceiverOfOneStreamDoesNotHoldUpTheOther) {
  std::promise<void> enough_colour;
  std::shared_future<void> released = enough_colour.get_future().share();
  std::atomic<int> depth{0}, colour{0}, colour_while_depth_waited{0};
  std::atomic<bool> waiting{false};
  DeviceSession::Callbacks callbacks;
  callbacks.opened = [](const CameraDevice&) {};
  callbacks.frame = [&](StreamKind kind, const SensorFrame&) {
    if (kind == StreamKind::kDepth && depth++ == 0) {
      waiting = true;
      released.wait_for(kLong);
      waiting = false;
    } else if (kind == StreamKind::kColour) {
      ++colour;
      if (waiting && ++colour_while_depth_waited == 10) enough_colour.set_value();
    }
  };
  {
    DeviceSession session("virtual://rubbish_bin?serial=SLOW&noise=0", CameraSettings(), 30.0,
                          callbacks);
    session.want(StreamKind::kDepth, true);
    session.want(StreamKind::kColour, true);
    EXPECT_EQ(released.wait_for(kLong), std::future_status::ready)
        << colour << " colour images, " << colour_while_depth_waited << " while depth waited";
  }
  EXPECT_GE(colour_while_depth_waited, 10);
}

/// Who waits for the camera to follow is answered when there will be none.
TEST(DeviceSession, EndingAnswersWhoWaits) {
  DeviceSession::Callbacks callbacks;
  callbacks.opened = [](const CameraDevice&) {};
  callbacks.frame = [](StreamKind, const SensorFrame&) {};
  DeviceSession session("virtual://rubbish_bin?serial=ENDS&slow=3", CameraSettings(), 2.0,
                        callbacks);
  CameraSettings settings;
  settings.depth_mode = {320, 240, 60};
  std::promise<void> asks;
  auto answer = std::async(std::launch::async, [&] {
    asks.set_value();
    return session.apply(settings);
  });
  asks.get_future().wait();
  // The camera is still being opened, so that the answer has to wait.
  EXPECT_EQ(answer.wait_for(std::chrono::milliseconds(200)), std::future_status::timeout);
  session.end();
  ASSERT_EQ(answer.wait_for(kLong), std::future_status::ready);
  EXPECT_EQ(answer.get(), "the driver is being unloaded");
  EXPECT_EQ(session.apply(settings), "the driver is being unloaded");
}

}  // namespace
}  // namespace dominant_plane_detection
