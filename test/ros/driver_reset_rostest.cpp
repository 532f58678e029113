// The service that closes a camera and opens it again.

#include <dominant_plane_detection/GetSerial.h>
#include <sensor_msgs/Image.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <future>
#include <iterator>
#include <utility>

#include "support/diagnostics.h"
#include "support/driver_test.h"
#include "support/ros_test.h"

namespace dominant_plane_detection {
namespace {

class DriverReset : public testing::Test {
 protected:
  using Images = Listener<sensor_msgs::Image>;
  using Answer = std_srvs::Trigger::Response;

  /// @return the answer; a failure with "no answer" where there was none.
  static Answer reset() {
    std_srvs::Trigger call;
    if (!ros::service::call("/camera/reset", call)) call.response.message = "no answer";
    return call.response;
  }
  static std::future<Answer> resetMeanwhile() { return std::async(std::launch::async, reset); }
  static bool offered() { return ros::service::exists("/camera/reset", false); }
  static std::string serial() {
    GetSerial call;
    return ros::service::call("/camera/get_serial", call) ? call.response.serial : "no answer";
  }
  /// @return whether images go on.
  static bool flow(const Images& images) {
    const std::size_t more = images.size() + 5;
    return spinUntil([&] { return images.size() >= more; });
  }

  ros::NodeHandle node_{"/camera"};
  Manager manager_;
  Diagnostics diagnostics_{node_};
};

TEST_F(DriverReset, TheCameraIsOpenedAgainAndStreamsRunOn) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=R1&noise=0"));
  Images depth(node_, "depth/image_raw"), colour(node_, "rgb/image_raw");
  ASSERT_TRUE(flow(depth) && flow(colour));
  for (const char* times : {"2", "3"}) {
    const Answer answer = reset();
    EXPECT_TRUE(answer.success);
    EXPECT_NE(answer.message.find("opened virtual://rubbish_bin?serial=R1"), std::string::npos)
        << answer.message;
    EXPECT_EQ(serial(), "R1");
    EXPECT_TRUE(flow(depth) && flow(colour));
    EXPECT_TRUE(spinUntil([&] {
      return diagnostics_.value("camera/driver: camera", "times opened") == times;
    })) << times;
  }
  for (std::size_t i = 1; i < depth.size(); ++i) {
    ASSERT_GT(depth.messages()[i]->header.stamp, depth.messages()[i - 1]->header.stamp);
  }
}

TEST_F(DriverReset, WithoutACameraItSaysThatThereIsNone) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "no_such_serial_number"));
  ASSERT_TRUE(spinUntil(offered));
  for (int i = 0; i < 2; ++i) {
    const Answer answer = reset();
    EXPECT_FALSE(answer.success);
    EXPECT_EQ(answer.message.rfind("no camera is open: ", 0), 0U) << answer.message;
    EXPECT_NE(answer.message.find("no_such_serial_number"), std::string::npos) << answer.message;
  }
}

/// The device takes three seconds to open; the nodelet's queue answers meanwhile.
TEST_F(DriverReset, NobodyElseWaitsForIt) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=R3&slow=3"));
  ASSERT_TRUE(spinUntil([] { return serial() == "R3"; }));
  std::future<Answer> answer = resetMeanwhile();
  ASSERT_TRUE(spinUntil([] { return serial().empty(); })) << "it is closed";
  EXPECT_EQ(serial(), "");
  EXPECT_FALSE(isReady(answer));
  ASSERT_TRUE(spinUntil([&] { return isReady(answer); }));
  EXPECT_TRUE(answer.get().success);
  EXPECT_EQ(serial(), "R3");
}

TEST_F(DriverReset, UnloadingAnswersWhoWaits) {
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=R4&slow=1"));
  ASSERT_TRUE(spinUntil([] { return serial() == "R4"; }));
  std::future<Answer> first = resetMeanwhile(), second = resetMeanwhile();
  ASSERT_TRUE(spinUntil([] { return serial().empty(); }));
  ASSERT_TRUE(manager_.unload("/camera/driver"));
  ASSERT_TRUE(spinUntil([&] { return isReady(first) && isReady(second); }));
  // One may have been done before.
  const Answer answers[] = {first.get(), second.get()};
  EXPECT_TRUE(std::any_of(
      std::begin(answers), std::end(answers),
      [](const Answer& answer) { return answer.message.find("unloaded") != std::string::npos; }))
      << answers[0].message << "; " << answers[1].message;
  // And the camera is anybody's.
  ASSERT_TRUE(manager_.loadDriver("/camera", "virtual://rubbish_bin?serial=R4&slow=1"));
  EXPECT_TRUE(spinUntil([] { return serial() == "R4"; }));
}

}  // namespace
}  // namespace dominant_plane_detection
