#include "nodelets/name_claim.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>

namespace dominant_plane_detection {
namespace {

TEST(NameClaim, TheNextOfANameWaitsUntilTheOneBeforeIsGone) {
  auto first = std::make_unique<NameClaim>("/camera/driver");
  const NameClaim other("/camera/plane_detection");
  auto second = std::async(std::launch::async, [] { const NameClaim claim("/camera/driver"); });
  EXPECT_EQ(second.wait_for(std::chrono::milliseconds(200)), std::future_status::timeout);
  first.reset();
  ASSERT_EQ(second.wait_for(std::chrono::seconds(20)), std::future_status::ready);
  EXPECT_NO_THROW(second.get());
}

}  // namespace
}  // namespace dominant_plane_detection
