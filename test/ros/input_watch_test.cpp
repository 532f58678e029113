#include "ros/input_watch.h"

#include <gtest/gtest.h>

namespace dominant_plane_detection {
namespace {

using Problem = InputWatch::Problem;

TEST(InputWatch, SilenceBeginsWithTheSubscriptionOrTheLastImage) {
  InputWatch watch(10.0);
  EXPECT_EQ(watch.problem(14.9), Problem::kNone);
  EXPECT_EQ(watch.problem(15.1), Problem::kSilence);
  watch.sawImage(20.0);
  watch.sawMatch();
  EXPECT_EQ(watch.problem(24.9), Problem::kNone);
  EXPECT_EQ(watch.problem(25.1), Problem::kSilence);
}

TEST(InputWatch, ImagesWithoutCameraInfo) {
  InputWatch watch(10.0);
  for (double now = 10.1; now < 15.0; now += 0.1) {
    watch.sawImage(now);
    EXPECT_EQ(watch.problem(now), Problem::kNone) << now;
  }
  watch.sawImage(15.2);  // five seconds after the first
  EXPECT_EQ(watch.problem(15.2), Problem::kUnmatched);
  watch.sawMatch();
  EXPECT_EQ(watch.problem(15.2), Problem::kNone);
}

TEST(InputWatch, TheFirstImageAfterASilenceMayWaitForItsCameraInfo) {
  InputWatch watch(10.0);
  watch.sawImage(100.0);
  EXPECT_EQ(watch.problem(100.0), Problem::kNone);
  for (double now = 100.0; now < 105.2; now += 0.1) watch.sawImage(now);
  EXPECT_EQ(watch.problem(105.2), Problem::kUnmatched);
}

/// Images that are few have their camera_info all the same.
TEST(InputWatch, ALowRateIsNoProblem) {
  InputWatch watch(10.0);
  for (double now = 10.0; now < 60.0; now += 4.9) {
    watch.sawImage(now);
    EXPECT_EQ(watch.problem(now + 0.001), Problem::kNone);
    watch.sawMatch();
    EXPECT_EQ(watch.problem(now + 4.8), Problem::kNone);
  }
}

}  // namespace
}  // namespace dominant_plane_detection
