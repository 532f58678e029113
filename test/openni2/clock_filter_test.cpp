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
    stamp_ = filter.stamp(device, arrival_);
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
  filter.stamp(0, 100.0);
  filter.stamp(33333, 100.033333);
  EXPECT_NEAR(filter.stamp(66666, 101.5), 100.066666, 1e-4);
  EXPECT_NEAR(filter.stamp(1533333, 101.533333), 101.533333, 2e-3);
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
      stamp = filter.stamp(device, now);
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

}  // namespace
}  // namespace dominant_plane_detection
