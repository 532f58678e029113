#include "ros/node_parameters.h"

#include "core/parameter_text.h"

namespace dominant_plane_detection {
namespace {

constexpr int kMostCells = 1000;  // [#] on a side of the map

}  // namespace

std::vector<std::string> findErrors(const NodeParameters& p) {
  std::vector<std::string> errors = findRangeErrors(p);
  if (p.ground_frame.empty()) errors.emplace_back("ground_frame: expected a name, got none");
  return errors;
}

void setParameter(NodeParameters& parameters, const std::string& name, const std::string& value) {
  // As users of other packages are used to.
  const bool is_switch = name == "publish_tf" && (value == "true" || value == "false");
  setByName(parameters, name, !is_switch ? value : value == "true" ? "ground" : "none");
}

std::vector<std::string> refuseContradictions(NodeParameters& p) {
  std::vector<std::string> errors;
  if (!(p.clearance_height < p.max_obstacle_height)) {
    errors.push_back("clearance_height has to be smaller than max_obstacle_height, got " +
                     std::to_string(p.clearance_height) + " m and " +
                     std::to_string(p.max_obstacle_height) + " m");
    p.clearance_height = NodeParameters().clearance_height;
    p.max_obstacle_height = NodeParameters().max_obstacle_height;
  }
  if (p.smoothing_time > 0.0 && !p.tracking) {
    errors.emplace_back("smoothing_time needs tracking");
    p.smoothing_time = 0.0;
  }
  if (!p.base_frame.empty() && p.base_frame == p.ground_frame) {
    errors.emplace_back("base_frame and ground_frame have to be two frames, got " + p.base_frame +
                        " for both");
    p.base_frame.clear();
  }
  if (!(p.map_size >= p.map_resolution && p.map_size <= kMostCells * p.map_resolution)) {
    errors.push_back("map_size has to be 1 to " + std::to_string(kMostCells) +
                     " cells of map_resolution, got " + std::to_string(p.map_size) + " m and " +
                     std::to_string(p.map_resolution) + " m");
    p.map_size = NodeParameters().map_size;
    p.map_resolution = NodeParameters().map_resolution;
  }
  if (!p.odom_frame.empty() && p.odom_frame == p.ground_frame) {
    errors.emplace_back("odom_frame and ground_frame have to be two frames, got " + p.odom_frame +
                        " for both");
    p.odom_frame.clear();
  }
  if (!p.odom_frame.empty() && p.odom_frame == p.base_frame) {
    errors.emplace_back("odom_frame has to be a frame that base_frame moves in, got " +
                        p.odom_frame + " for both");
    p.odom_frame.clear();
  }
  if (!p.base_frame.empty()) return errors;
  if (p.publish_tf == TfOutput::kBase) {
    errors.emplace_back("publish_tf base needs a base_frame, got none");
    p.publish_tf = TfOutput::kNone;
  }
  if (p.clouds_in_base_frame) {
    errors.emplace_back("clouds_in_base_frame needs a base_frame, got none");
    p.clouds_in_base_frame = false;
  }
  return errors;
}

ObstacleLimits obstacleLimits(const NodeParameters& parameters) {
  return {parameters.clearance_height, parameters.max_obstacle_height};
}

NodeParameters loadNodeParameters(const ros::NodeHandle& private_node) {
  NodeParameters parameters;
  std::vector<std::string> errors = readValues(private_node, parameters);
  for (const std::string& error : refuseContradictions(parameters)) errors.push_back(error);
  if (!errors.empty()) {
    ROS_ERROR_STREAM("Refused parameters of " << private_node.getNamespace()
                                              << ", their defaults are used: " << joined(errors));
  }
  return parameters;
}

}  // namespace dominant_plane_detection
