#include "doctor/robot_rules.h"

#include <gtest/gtest.h>

#include "support/finding.h"

namespace dominant_plane_detection {
namespace {

RobotFacts healthy() {
  RobotFacts robot;
  robot.base_frame = "base_link";
  robot.height = 0.45;
  robot.tf_height = 0.46;
  return robot;
}

TEST(RobotRules, NothingIsWrongWithARobotWhosePlaneIsWhereTfHasIt) {
  EXPECT_TRUE(examineRobot(healthy()).empty());
  EXPECT_TRUE(examineRobot(RobotFacts()).empty());
}

TEST(RobotRules, TfIsMissedOnlyWhereItIsWanted) {
  RobotFacts robot = healthy();
  robot.tf_problem = "No tf from base_link to optical.";
  robot.tf_height = 0.0;
  expectOnly(examineRobot(robot), Code::kNoTf,
             {"No tf from base_link", "base_frame", "static_transform_publisher"});
  robot.base_frame.clear();
  EXPECT_TRUE(examineRobot(robot).empty());
}

TEST(RobotRules, TfThatComesTooLateIsNotMissing) {
  RobotFacts robot = healthy();
  robot.tf_problem = "No tf from base_link to optical of the image's time: too old";
  robot.tf_is_late = true;
  expectOnly(examineRobot(robot), Code::kNoTf, {"too late or too seldom", "50 ms"});
  EXPECT_EQ(examineRobot(robot).front().text.find("static_transform_publisher"), std::string::npos);
}

TEST(RobotRules, ThePlaneIsNotWhereTfHasTheGround) {
  RobotFacts robot = healthy();
  robot.mount = "mount moved: by 5 deg";
  expectOnly(examineRobot(robot), Code::kTfDisagrees,
             {"mount moved: by 5 deg.", "calibrate_mount", "mount_pitch"});
}

TEST(RobotRules, ATableIsNoMountThatMovedWhereTheFloorIsSeenAsWell) {
  RobotFacts robot = healthy();
  robot.mount = "The plane is 0.7 m above where tf has the ground.";
  robot.mount_is_height = true;
  robot.planes_elsewhere = 100;
  expectOnly(examineRobot(robot), Code::kTfDisagrees);
  robot.planes_at_tf_height = 11;
  EXPECT_TRUE(examineRobot(robot).empty());
  robot.mount_is_height = false;  // at the right height it is turned
  expectOnly(examineRobot(robot), Code::kTfDisagrees);
}

TEST(RobotRules, AHeightThatIsOffByAUnitIsOneOfDepth) {
  RobotFacts robot = healthy();
  robot.mount = "The plane is 0.36 m above where tf has the ground.";
  robot.height = 0.092;
  expectOnly(examineRobot(robot), Code::kDepthScale,
             {"0.092 m", "0.460 m", "multiplied by 5", "z_scale"});
  robot.height = 4.6;
  expectOnly(examineRobot(robot), Code::kDepthScale, {"multiplied by 0.1"});
  robot.height = 1.2;  // no unit
  expectOnly(examineRobot(robot), Code::kTfDisagrees);
}

TEST(RobotRules, ATableIsNoUnit) {
  // 0.78 m high, before a camera 1.0 m up.
  RobotFacts robot = healthy();
  robot.height = 0.22;
  robot.tf_height = 1.0;
  EXPECT_TRUE(examineRobot(robot).empty()) << "seen just now";
  robot.mount = "The plane is 0.78 m above where tf has the ground.";
  robot.mount_is_height = true;
  robot.planes_elsewhere = 100;
  robot.planes_at_tf_height = 11;
  EXPECT_TRUE(examineRobot(robot).empty()) << "the floor is seen as well";
  robot.planes_at_tf_height = 10;
  expectOnly(examineRobot(robot), Code::kDepthScale, {"multiplied by 5", "or another level"});
}

}  // namespace
}  // namespace dominant_plane_detection
