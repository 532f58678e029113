#include "openni2/reconnect_policy.h"

#include <gtest/gtest.h>

namespace dominant_plane_detection {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class ReconnectPolicyTest : public testing::Test {
 protected:
  /// @return how long it is until the next look.
  milliseconds wait() const {
    milliseconds time{0};
    while (!policy_.due(now_ + time)) time += milliseconds(10);
    return time;
  }
  ReconnectPolicy policy_;
  ReconnectPolicy::Clock::time_point now_ = ReconnectPolicy::Clock::now();
};

TEST_F(ReconnectPolicyTest, LooksAtOnceAndThenLessAndLessOften) {
  EXPECT_EQ(wait(), milliseconds(0));
  for (const int expected : {250, 500, 1000, 2000, 4000, 5000, 5000}) {
    policy_.searchedInVain(now_, now_);
    EXPECT_EQ(wait(), milliseconds(expected));
    now_ += milliseconds(expected);
  }
  policy_.arrived(now_);
  EXPECT_EQ(wait(), milliseconds(0));
  policy_.opened(now_);
  now_ += milliseconds(10);
  policy_.searchedInVain(now_, now_);
  EXPECT_EQ(wait(), milliseconds(250));
}

/// One that came after the list of cameras was read, and before the search ended.
TEST_F(ReconnectPolicyTest, ACameraThatComesWhileItIsLookedForIsLookedForAtOnce) {
  const auto begin = now_;
  policy_.arrived(now_ + milliseconds(50));
  now_ += milliseconds(100);
  policy_.searchedInVain(begin, now_);
  EXPECT_EQ(wait(), milliseconds(0));
}

TEST_F(ReconnectPolicyTest, ACameraThatWasWellIsLookedForSoon) {
  policy_.opened(now_);
  now_ += seconds(6);
  policy_.lost(now_);
  EXPECT_EQ(wait(), milliseconds(250));
  policy_.arrived(now_);
  EXPECT_EQ(wait(), milliseconds(0));
}

TEST_F(ReconnectPolicyTest, OneThatGoesAsSoonAsItComesHasToWait) {
  for (const int expected : {250, 500, 1000, 2000, 4000, 5000, 5000}) {
    policy_.opened(now_);
    policy_.lost(now_);
    policy_.arrived(now_);  // plugged in at once
    EXPECT_EQ(wait(), milliseconds(expected));
    now_ += milliseconds(expected);
  }
  policy_.opened(now_);
  now_ += seconds(6);
  policy_.lost(now_);
  policy_.arrived(now_);
  EXPECT_EQ(wait(), milliseconds(0));
}

}  // namespace
}  // namespace dominant_plane_detection
