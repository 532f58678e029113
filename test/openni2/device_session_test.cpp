// The session that keeps a camera, without ROS around it.

#include "openni2/device_session.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

#include "support/driver_test.h"

namespace dominant_plane_detection {
namespace {

constexpr std::chrono::seconds kLong{20};

/// @return false when a condition still does not hold after a while.
bool becomes(const std::function<bool()>& condition, std::chrono::seconds patience = kLong) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

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

/// With nobody looking for it, only the news that it was plugged in brings it back.
TEST(DeviceSession, ACameraThatIsPluggedInIsOpenedAtOnce) {
  const std::string uri = "virtual://rubbish_bin?serial=NEWS&noise=0";
  std::atomic<int> frames{0}, opened{0};
  DeviceSession::Callbacks callbacks;
  callbacks.opened = [&](const CameraDevice&) { ++opened; };
  callbacks.frame = [&](StreamKind, const SensorFrame&) { ++frames; };
  DeviceSession session(uri, CameraSettings(), 30.0, callbacks,
                        ReconnectPolicy(std::chrono::hours(1)));
  session.want(StreamKind::kDepth, true);
  ASSERT_TRUE(becomes([&] { return frames >= 3; }));
  Probe(uri).unplug(0.5);
  ASSERT_TRUE(becomes([&] { return opened == 2; }));
  const int before = frames;
  EXPECT_TRUE(becomes([&] { return frames >= before + 3; }));
}

/// Whoever keeps all images gets no more of them than 400 MB, until some are let go.
TEST(DeviceSession, ImagesThatAreKeptHaveABound) {
  ros::Time::init();  // the line about it in the log is not written too often
  constexpr std::size_t kImage = 640 * 480 * 3;
  constexpr std::size_t kMost = ImagePool::kMostTaken / kImage + 1;
  std::mutex mutex;
  std::vector<sensor_msgs::ImagePtr> kept;
  std::atomic<int> last_number{0};
  const auto size = [&] {
    const std::lock_guard<std::mutex> lock(mutex);
    return kept.size();
  };
  std::atomic<int> depth{0};
  DeviceSession::Callbacks callbacks;
  callbacks.opened = [](const CameraDevice&) {};
  callbacks.frame = [&](StreamKind kind, const SensorFrame& frame) {
    if (kind == StreamKind::kDepth) ++depth;
    if (kind != StreamKind::kColour) return;
    const std::lock_guard<std::mutex> lock(mutex);
    kept.push_back(frame.image);
    last_number = frame.number;
  };
  DeviceSession session("virtual://rubbish_bin?serial=HOARD&noise=0", CameraSettings(), 2.0,
                        callbacks);
  session.want(StreamKind::kColour, true);
  ASSERT_TRUE(becomes([&] { return size() >= kMost; }, 10 * kLong)) << size() << " of " << kMost;
  session.want(StreamKind::kDepth, true);
  ASSERT_TRUE(becomes([&] { return depth >= 30; })) << "other streams have a bound of their own";
  EXPECT_EQ(size(), kMost);
  const int number_then = last_number;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    kept.clear();
  }
  ASSERT_TRUE(becomes([&] { return size() >= 3; }));
  EXPECT_GT(last_number, number_then + 10) << "what was left out is missing in the numbers";
  EXPECT_EQ(session.status().stream(StreamKind::kColour).restarts, 0) << "it was never silent";
}

/// An image that cannot be delivered, as when memory runs out, is lost alone.
TEST(DeviceSession, AnExceptionDoesNotEndAStream) {
  ros::Time::init();
  std::atomic<int> frames{0};
  DeviceSession::Callbacks callbacks;
  callbacks.opened = [](const CameraDevice&) {};
  callbacks.frame = [&](StreamKind, const SensorFrame&) {
    if (++frames == 1) throw std::runtime_error("no memory");
  };
  DeviceSession session("virtual://rubbish_bin?serial=THROWS&noise=0", CameraSettings(), 30.0,
                        callbacks);
  session.want(StreamKind::kDepth, true);
  EXPECT_TRUE(becomes([&] { return frames >= 5; })) << frames;
}

/// Who waits for the camera to follow is answered when there will be none.
TEST(DeviceSession, EndingAnswersWhoWaits) {
  std::promise<void> opening, never;
  DeviceSession::Callbacks callbacks;
  callbacks.opened = [&](const CameraDevice&) {
    opening.set_value();
    never.get_future().wait_for(std::chrono::seconds(3));
  };
  callbacks.frame = [](StreamKind, const SensorFrame&) {};
  DeviceSession session("virtual://rubbish_bin?serial=ENDS", CameraSettings(), 2.0, callbacks);
  ASSERT_EQ(opening.get_future().wait_for(kLong), std::future_status::ready);
  CameraSettings settings;
  settings.depth_mode = {320, 240, 60};
  std::promise<void> asks;
  auto answer = std::async(std::launch::async, [&] {
    asks.set_value();
    return session.apply(settings);
  });
  asks.get_future().wait();
  // The session's thread is held up for three seconds, so that the answer has to wait.
  EXPECT_EQ(answer.wait_for(std::chrono::milliseconds(200)), std::future_status::timeout);
  session.end();
  ASSERT_EQ(answer.wait_for(kLong), std::future_status::ready);
  EXPECT_EQ(answer.get(), "the driver is being unloaded");
  EXPECT_EQ(session.apply(settings), "the driver is being unloaded");
  EXPECT_EQ(session.reset(), "the driver is being unloaded");
}

/// With nobody looking for it, only the reset brings a camera that is there after all.
TEST(DeviceSession, AResetLooksForACameraAtOnce) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("reset_scene_" + std::to_string(getpid()) + ".yaml");
  std::filesystem::remove(file);
  std::atomic<int> opened{0}, frames{0};
  DeviceSession::Callbacks callbacks;
  callbacks.opened = [&](const CameraDevice&) { ++opened; };
  callbacks.frame = [&](StreamKind, const SensorFrame&) { ++frames; };
  DeviceSession session("virtual://" + file.string() + "?noise=0", CameraSettings(), 30.0,
                        callbacks, ReconnectPolicy(std::chrono::hours(1)));
  session.want(StreamKind::kDepth, true);
  EXPECT_NE(session.reset().find(file.string()), std::string::npos) << "why there is none";
  EXPECT_FALSE(session.status().open);
  std::filesystem::copy_file(DPD_SOURCE "/test/ros/still_scene.yaml", file);
  EXPECT_EQ(session.reset(), "");
  EXPECT_TRUE(becomes([&] { return frames >= 3; }));
  EXPECT_EQ(opened, 1);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace dominant_plane_detection
