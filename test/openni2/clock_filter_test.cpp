#include "openni2/clock_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace dominant_plane_detection {
namespace {

constexpr double kRate = 30.0;    // [1/s]
constexpr double kEpoch = 1.6e9;  // [s] this computer's time at the device's 0
constexpr double kLeast = 0.004;  // [s] on the way at least

/// A camera whose frames arrive up to `jitter` later than they could, and some much later.
class Camera {
 public:
  explicit Camera(double drift) : drift_(drift) {}

  /// @return [s] error of the stamp of the next frame: by how much more than the least delay.
  double next(ClockFilter& filter) {
    const double time = static_cast<double>(frame_++) / kRate;
    const bool stalled = frame_ % 97 == 0;
    const double arrival =
        kEpoch + time + kLeast + 0.005 * uniform_(generator_) + (stalled ? 0.2 : 0.0);
    const auto device =
        static_cast<std::uint64_t>(1e6 * (1.0 + drift_) * (time - restart_) + 11680);
    arrival_ = std::max(arrival, arrival_);
    stamp_ = filter.stamp(0, device, arrival_);
    return stamp_ - (kEpoch + time + kLeast);
  }
  void restartClock() { restart_ = static_cast<double>(frame_) / kRate; }
  double stamp() const { return stamp_; }
  double arrival() const { return arrival_; }

 private:
  double drift_;
  double restart_ = 0.0;
  double arrival_ = 0.0;
  double stamp_ = 0.0;
  int frame_ = 0;
  std::mt19937 generator_{5};
  std::uniform_real_distribution<double> uniform_;
};

class ClockFilterDrift : public testing::TestWithParam<double> {};

TEST_P(ClockFilterDrift, StampsAreMonotonicAndRight) {
  Camera camera(GetParam());
  ClockFilter filter;
  double last = 0.0;
  double worst = 0.0;
  for (int i = 0; i < 36000; ++i) {  // 20 minutes
    const double error = camera.next(filter);
    EXPECT_GT(camera.stamp(), last);
    EXPECT_LE(camera.stamp(), camera.arrival() + 1e-6);
    last = camera.stamp();
    if (i > 100) worst = std::max(worst, std::abs(error));
  }
  EXPECT_LT(worst, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Drifts, ClockFilterDrift, testing::Values(0.0, 75e-6, -75e-6, 200e-6));

TEST(ClockFilter, ALoopingRecordingBeginsAnew) {
  Camera camera(0.0);
  ClockFilter filter;
  double last = 0.0;
  for (int i = 0; i < 900; ++i) {
    if (i % 100 == 50) camera.restartClock();
    const double error = camera.next(filter);
    EXPECT_GT(camera.stamp(), last) << i;
    last = camera.stamp();
    EXPECT_LT(std::abs(error), i % 100 == 50 ? 0.01 : 0.008) << i;
  }
}

TEST(ClockFilter, OneFrameThatComesLateMovesNothing) {
  ClockFilter filter;
  filter.stamp(0, 0, 100.0);
  filter.stamp(0, 33333, 100.033333);
  EXPECT_NEAR(filter.stamp(0, 66666, 101.5), 100.066666, 1e-4);
  EXPECT_NEAR(filter.stamp(0, 1533333, 101.533333), 101.533333, 2e-3);
}

TEST(ClockFilter, FollowsAClockThatWasSet) {
  ClockFilter filter;
  std::uint64_t device = 0;
  double now = 1000.0;
  double stamp = 0.0;
  const auto run = [&](int frames) {
    for (int i = 0; i < frames; ++i) {
      device += 33333;
      now += 0.033333;
      stamp = filter.stamp(0, device, now);
    }
  };
  run(100);
  now += 3600.0;  // forward: believed when it stays so
  run(60);
  EXPECT_NEAR(stamp, now, 0.001);
  now -= 7200.0;  // back: at once
  run(1);
  EXPECT_NEAR(stamp, now, 0.001);
}

/// Depth and colour of a device, each on its way for a while of its own.
class TwoStreams {
 public:
  /// The next exposure.
  /// @param restarted whether depth's clock has begun anew, and colour's has.
  void expose(bool depth_restarted, bool colour_restarted) {
    now_ += 1.0 / kRate;
    depth_time_ = depth_restarted ? now_ - restart_ : now_;
    colour_time_ = colour_restarted ? now_ - restart_ : now_;
    depth = filter_.stamp(0, toDevice(depth_time_), kEpoch + now_ + delay());
    colour = filter_.stamp(1, toDevice(colour_time_), kEpoch + now_ + 0.01 + delay());
  }
  void restart() { restart_ = now_ + 1.0 / kRate; }
  double truth() const { return kEpoch + now_ + kLeast; }
  double depth = 0.0, colour = 0.0;

 private:
  double delay() { return kLeast + 0.005 * uniform_(generator_); }
  static std::uint64_t toDevice(double time) {
    return static_cast<std::uint64_t>(std::llround(1e6 * time) + 11680);
  }
  ClockFilter filter_;
  double now_ = 0.0, restart_ = 0.0, depth_time_ = 0.0, colour_time_ = 0.0;
  std::mt19937 generator_{3};
  std::uniform_real_distribution<double> uniform_;
};

TEST(ClockFilter, FramesOfOneExposureGetOneStamp) {
  TwoStreams streams;
  double last = 0.0;
  for (int i = 0; i < 1000; ++i) {
    streams.expose(false, false);
    EXPECT_EQ(streams.depth, streams.colour) << i;
    EXPECT_GT(streams.depth, last) << i;
    if (i > 30) {
      EXPECT_NEAR(streams.depth, streams.truth(), 0.002) << i;
    }
    last = streams.depth;
  }
}

/// Each stream has a thread of its own, and the later arrival may be looked at first: it knows less
/// of the clock, and has given the exposure its stamp all the same.
TEST(ClockFilter, TheOrderInWhichStreamsAreLookedAtIsNoMatter) {
  ClockFilter filter;
  const double depth = filter.stamp(0, 1000000, 100.050);
  EXPECT_EQ(filter.stamp(1, 1000000, 100.004), depth);
  // The next exposure has learned from both.
  EXPECT_NEAR(filter.stamp(0, 1100000, 100.150), 100.104, 1e-3);
}

/// The last colour images of a recording come when depth has begun anew: they are no reason to
/// doubt the new beginning.
TEST(ClockFilter, StreamsBeginAnewOneAfterTheOther) {
  TwoStreams streams;
  for (int i = 0; i < 100; ++i) streams.expose(false, false);
  streams.restart();
  double last_depth = 0.0, last_colour = 0.0;
  for (int i = 0; i < 100; ++i) {
    streams.expose(true, i >= 5);
    EXPECT_GT(streams.depth, last_depth) << i;
    EXPECT_GT(streams.colour, last_colour) << i;
    EXPECT_NEAR(streams.depth, streams.truth(), 0.01) << i;
    EXPECT_NEAR(streams.colour, streams.truth(), 0.01) << i;
    if (i >= 5) {
      EXPECT_EQ(streams.depth, streams.colour) << i;
    }
    last_depth = streams.depth;
    last_colour = streams.colour;
  }
}

TEST(ClockFilter, AFrameThatComesTwiceIsNoNewBeginning) {
  ClockFilter filter;
  std::uint64_t device = 0;
  double now = 1000.0;
  double stamp = 0.0;
  for (int i = 0; i < 100; ++i) {
    device += 33333;
    now += 0.033333;
    stamp = filter.stamp(0, device, now);
  }
  EXPECT_EQ(filter.stamp(0, device, now + 0.09), stamp);
  EXPECT_NEAR(filter.stamp(0, device + 33333, now + 0.033333), now + 0.033333, 1e-4);
}

/// A stream that was off for a while finds the clock as the other left it.
TEST(ClockFilter, AStreamThatPausesComesBackInTime) {
  ClockFilter filter;
  std::uint64_t device = 0;
  double now = 1000.0;
  const auto expose = [&](bool colour) {
    device += 33333;
    now += 0.033333;
    const double depth = filter.stamp(0, device, now + 0.004);
    return colour ? filter.stamp(1, device, now + 0.020) - depth : 0.0;
  };
  for (int i = 0; i < 900; ++i) {
    EXPECT_EQ(expose(i % 300 < 100), 0.0) << i;
  }
  // Both were off.
  device += 60000000;
  now += 60.0;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(expose(true), 0.0) << i;
}

}  // namespace
}  // namespace dominant_plane_detection
