// The doctor where time stands still, and where a clock runs.

#include <rosgraph_msgs/Clock.h>

#include "doctor_fixture.h"
#include "support/diagnostics.h"

namespace dominant_plane_detection {
namespace {

class DoctorClock : public testing::Test {
 protected:
  DoctorClock()
      : images_(node_.advertise<sensor_msgs::Image>("/no_clock/depth/image_raw", 2)),
        infos_(node_.advertise<sensor_msgs::CameraInfo>("/no_clock/depth/camera_info", 2)) {}

  void publish() {
    image_stamp_ += ros::Duration(0.2);
    bin_.image.header.stamp = bin_.info.header.stamp = image_stamp_;
    bin_.image.header.frame_id = bin_.info.header.frame_id = "optical";
    infos_.publish(bin_.info);
    images_.publish(bin_.image);
  }

  ros::NodeHandle node_;
  BinCamera bin_;
  ros::Publisher images_;
  ros::Publisher infos_;
  ros::Time image_stamp_{1000.0};
};

TEST_F(DoctorClock, IsMissedAndThenRuns) {
  Diagnostics diagnostics(node_);
  ASSERT_TRUE(
      spinUntil([&] { return diagnostics.of("no_clock/detection: detection").has_value(); }));
  const Outcome outcome = runDoctor(duration(2.0), [&] { publish(); });
  EXPECT_EQ(outcome.status, 1) << outcome.text;
  EXPECT_EQ(outcome.text.rfind("no-clock: ", 0), 0U) << outcome.text;
  EXPECT_NE(outcome.text.find("rosbag play --clock"), std::string::npos) << outcome.text;
  EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;

  ros::Publisher clock = node_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  const Outcome ticking = runDoctor(duration(3.0), [&] {
    publish();
    rosgraph_msgs::Clock now;
    now.clock = image_stamp_ + ros::Duration(0.01);
    clock.publish(now);
  });
  EXPECT_EQ(ticking.status, 0) << ticking.text;
}

}  // namespace
}  // namespace dominant_plane_detection
