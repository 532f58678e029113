#include "doctor/robot_rules.h"

#include <cmath>
#include <cstdio>

#include "doctor/depth_spread.h"

namespace dominant_plane_detection {

namespace {

/// Where tf's ground is seen now and then, planes at other heights are tables and other levels.
bool seesGroundOfTf(const RobotFacts& robot) {
  constexpr std::size_t kNowAndThen = 10;
  return kNowAndThen * robot.planes_at_tf_height > robot.planes_elsewhere;
}

bool isAnotherLevel(const RobotFacts& robot) {
  return robot.mount_is_height && seesGroundOfTf(robot);
}

/// What to do about tf that has both frames, but not when an image needs them.
std::string adviceOnLateTf(const RobotFacts& robot) {
  return " base_frame is set to " + robot.base_frame +
         ", so that up and height are to come from tf, and tf has both frames, but too late or too "
         "seldom: an image takes tf of its own time, or of 50 ms before at the most. Publish the "
         "moving joints more often and without delay (30 times a second or more), set the clocks "
         "of the computers alike, or leave base_frame empty.";
}

std::string adviceOnNoTf(const RobotFacts& robot) {
  return " base_frame is set to " + robot.base_frame +
         ", so that up and height are to come from tf; nobody publishes the mount, or a frame has "
         "another name. Start what does (robot_state_publisher, or static_transform_publisher X Y "
         "Z YAW PITCH ROLL " +
         robot.base_frame + " CAMERA_LINK), correct base_frame, or leave it empty.";
}

}  // namespace

std::optional<Finding> findNoTf(const RobotFacts& robot) {
  if (robot.base_frame.empty() || robot.tf_problem.empty()) return std::nullopt;
  return Finding{Code::kNoTf, robot.tf_problem +
                                  (robot.tf_is_late ? adviceOnLateTf(robot) : adviceOnNoTf(robot))};
}

std::optional<Finding> findScaleByHeight(const RobotFacts& robot) {
  /// [-] A mount is measured better, and two common units differ by more.
  constexpr double kNear = 0.2;
  if (robot.mount.empty() || seesGroundOfTf(robot)) return std::nullopt;
  if (!(robot.height > 0.0) || !(robot.tf_height > 0.0)) return std::nullopt;
  const double ratio = robot.tf_height / robot.height;
  for (const DepthUnit& unit : kDepthUnits) {
    if (!(std::abs(std::log(ratio / unit.factor)) < kNear)) continue;
    char text[500];
    std::snprintf(text, sizeof(text),
                  "By the plane the camera is %.3f m high, by tf %.3f m: all depth has to be "
                  "multiplied by %g, as images are %s. Have the driver publish 16UC1 in "
                  "millimetres or 32FC1 in metres, or set its z_scale; for PNG files give "
                  "--depth-scale. Or the plane is no ground, but a table or another level.",
                  robot.height, robot.tf_height, unit.factor, unit.meaning);
    return Finding{Code::kDepthScale, text};
  }
  return std::nullopt;
}

std::optional<Finding> findTfDisagrees(const RobotFacts& robot) {
  if (robot.mount.empty() || isAnotherLevel(robot) || findScaleByHeight(robot)) {
    return std::nullopt;
  }
  const char last = robot.mount.back();
  return Finding{Code::kTfDisagrees,
                 robot.mount + (last == '.' ? "" : ".") +
                     " The mount was knocked, or was written wrongly into tf. Measure it over free "
                     "floor with calibrate_mount, and correct the transform (mount_height, "
                     "mount_pitch and mount_roll of pioneer.launch, or the robot's model)."};
}

Findings examineRobot(const RobotFacts& robot) {
  Findings findings;
  for (const auto rule : {findNoTf, findScaleByHeight, findTfDisagrees}) {
    if (const auto finding = rule(robot)) findings.push_back(*finding);
  }
  return findings;
}

}  // namespace dominant_plane_detection
