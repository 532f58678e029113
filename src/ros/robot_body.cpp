#include "ros/robot_body.h"

#include <ros/console.h>

#include <cmath>
#include <stdexcept>

namespace dominant_plane_detection {
namespace {

using XmlRpc::XmlRpcValue;
constexpr double kThrottle = 5.0;  // [s] between lines of the same kind

double asNumber(XmlRpcValue& value) {
  if (value.getType() == XmlRpcValue::TypeInt) return static_cast<int>(value);
  if (value.getType() == XmlRpcValue::TypeDouble) return static_cast<double>(value);
  return NAN;
}

Eigen::Vector3d asPoint(XmlRpcValue& box, const char* corner) {
  Eigen::Vector3d point = Eigen::Vector3d::Constant(NAN);
  if (box.getType() != XmlRpcValue::TypeStruct || !box.hasMember(corner)) return point;
  XmlRpcValue& numbers = box[corner];
  if (numbers.getType() != XmlRpcValue::TypeArray || numbers.size() != 3) return point;
  for (int i = 0; i < 3; ++i) point[i] = asNumber(numbers[i]);
  return point;
}

}  // namespace

std::vector<BodyMask::Box> asBoxes(XmlRpcValue value) {
  const std::string wanted = "expected a list of boxes {min: [x, y, z], max: [x, y, z]} in metres";
  if (value.getType() != XmlRpcValue::TypeArray) {
    throw std::invalid_argument("robot_body: " + wanted + ", got something else");
  }
  std::vector<BodyMask::Box> boxes;
  for (int i = 0; i < value.size(); ++i) {
    const Eigen::Vector3d low = asPoint(value[i], "min"), high = asPoint(value[i], "max");
    if (!(low.array() < high.array()).all()) {
      throw std::invalid_argument("robot_body: " + wanted + ", min below max; box " +
                                  std::to_string(i) + " is none");
    }
    boxes.emplace_back(low, high);
  }
  return boxes;
}

RobotBody::RobotBody(const ros::NodeHandle& private_node, const NodeParameters& parameters,
                     RobotFrames& frames, RayTable& rays)
    : base_frame_(parameters.base_frame), frames_(frames), rays_(rays) {
  XmlRpcValue value;
  if (!private_node.getParam("robot_body", value)) return;
  try {
    if (base_frame_.empty() || parameters.publish_tf == TfOutput::kBase) {
      throw std::invalid_argument(
          "robot_body: expected a base_frame that its boxes are in and that tf has before the "
          "plane "
          "is known");
    }
    mask_ = BodyMask(asBoxes(value));
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM("Refused " << private_node.resolveName("robot_body")
                                << ", nothing is masked: " << error.what());
  }
}

DepthView RobotBody::mask(const DetectionInputs::Frame& frame) {
  if (mask_.empty()) return frame.depth;
  const auto pose = frames_.pose(base_frame_, frame.header.frame_id, frame.header.stamp);
  if (!pose.transform) {
    ROS_WARN_STREAM_THROTTLE(kThrottle, "The robot's body is not masked: " << pose.problem);
    return frame.depth;
  }
  rays_.build(frame.camera);
  return mask_.mask(frame.depth, rays_, *pose.transform);
}

}  // namespace dominant_plane_detection
