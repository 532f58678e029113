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
  watch.sawMatch(20.0);
  EXPECT_EQ(watch.problem(24.9), Problem::kNone);
  EXPECT_EQ(watch.problem(25.1), Problem::kSilence);
}

TEST(InputWatch, ImagesWithoutCameraInfo) {
  InputWatch watch(10.0);
  for (double now = 10.1; now < 15.0; now += 0.1) {
    watch.sawImage(now);
    EXPECT_EQ(watch.problem(now), Problem::kNone) << now;
  }
  watch.sawImage(15.1);
  EXPECT_EQ(watch.problem(15.1), Problem::kUnmatched);
  watch.sawMatch(15.2);
  EXPECT_EQ(watch.problem(15.2), Problem::kNone);
}

TEST(InputWatch, TheFirstImageAfterASilenceMayWaitForItsCameraInfo) {
  InputWatch watch(10.0);
  watch.sawImage(100.0);
  EXPECT_EQ(watch.problem(100.0), Problem::kNone);
  for (double now = 100.0; now < 105.2; now += 0.1) watch.sawImage(now);
  EXPECT_EQ(watch.problem(105.2), Problem::kUnmatched);
}

}  // namespace
}  // namespace dominant_plane_detection
