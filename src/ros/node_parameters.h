#pragma once

#include <ros/node_handle.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/parameter_table.h"
#include "navigation/obstacle_limits.h"
#include "ros/ros_parameters.h"

namespace dominant_plane_detection {

/// Which transform goes out on tf.
enum class TfOutput : std::uint8_t {
  kNone,
  kGround,  ///< from the optical frame to `ground_frame`
  kBase,    ///< from `base_frame` to the camera
};
template <>
inline constexpr std::array<const char*, 3> kChoiceNames<TfOutput>{"none", "ground", "base"};

/// What the detection nodelet is told about the robot and what it gives out; read at the start.
struct NodeParameters {
  std::string base_frame;  ///< of the robot, z = 0 its ground; empty: nothing is known
  std::string ground_frame = "ground";
  TfOutput publish_tf = TfOutput::kNone;
  bool use_imu = true;                ///< gravity tells up where tf does not
  bool tracking = true;               ///< the last plane is looked for first
  double smoothing_time = 0.0;        ///< [s] of planes that are tracked; 0: each image alone
  double clearance_height = 0.0;      ///< [m] lower obstacles are not in scan, map and boxes
  double max_obstacle_height = 2.0;   ///< [m] higher obstacles are not in scan, map and boxes
  bool scan_missing_ground = false;   ///< missing ground is an obstacle of the scan
  std::string odom_frame;             ///< in which the map stays; empty: each map is of one image
  double map_resolution = 0.05;       ///< [m] side of a cell
  double map_size = 8.0;              ///< [m] side of the map
  double map_memory = 10.0;           ///< [s] in which what the map knows fades to 1/e
  double map_obstacle_height = 0.05;  ///< [m] lowest obstacle that must not be in a free cell
  bool map_missing_ground = false;    ///< missing ground is occupied in the map
  int box_images = 3;                 ///< [#] in which a thing has to be seen to be a box
  int stride = 1;                     ///< [px] clouds have every n-th point of every n-th row
  bool clouds_in_base_frame = false;  ///< instead of the optical frame
  bool coloured_clouds = false;       ///< XYZRGB with the registered picture's colours
};

/// The one list of the node's parameters; see `visitParameters` of the detection. Members are of
/// type std::string, bool, int or double, or an enumeration.
template <typename ParametersT, typename Visitor, IfParameters<ParametersT, NodeParameters> = 0>
void visitParameters(ParametersT& parameters, Visitor&& visit) {
  using Info = ParameterInfo;
  auto& p = parameters;
  visit(Info{"base_frame", "-", 0, 0,
             "frame of the robot with z up and z = 0 its ground: tf tells up and height by it; "
             "empty: none"},
        p.base_frame);
  visit(Info{"ground_frame", "-", 0, 0,
             "frame on the ground below the camera, of the scan; one name per camera"},
        p.ground_frame);
  visit(Info{"publish_tf", "-", 0, 2,
             "none: only what the scan needs; ground: the optical frame to ground_frame; base: "
             "base_frame, below the camera, to the camera's frames"},
        p.publish_tf);
  visit(
      Info{"use_imu", "-", 0, 1, "gravity by imu/data or imu/data_raw tells up where tf does not"},
      p.use_imu);
  visit(Info{"tracking", "-", 0, 1, "the last image's plane is looked for first"}, p.tracking);
  visit(Info{"smoothing_time", "s", 0, 10,
             "after which an image counts 1/e in a tracked plane; 0: it is that of one image"},
        p.smoothing_time);
  visit(Info{"clearance_height", "m", 0, 10, "lower obstacles are not in scan, map and boxes"},
        p.clearance_height);
  visit(Info{"max_obstacle_height", "m", 0, 100, "higher obstacles are not in scan, map and boxes"},
        p.max_obstacle_height);
  visit(Info{"scan_missing_ground", "-", 0, 1, "missing ground is an obstacle of the scan"},
        p.scan_missing_ground);
  visit(
      Info{"odom_frame", "-", 0, 0,
           "frame that does not jump, in which map and boxes are followed by tf; empty: none, and "
           "each map is of one image"},
      p.odom_frame);
  visit(Info{"map_resolution", "m", 0.01, 1, "side of a cell of the map"}, p.map_resolution);
  visit(Info{"map_size", "m", 0.1, 50, "side of the map, which has the camera in its middle"},
        p.map_size);
  visit(Info{"map_memory", "s", 0.1, 3600,
             "in which what the map knows, and does not see, fades to 1/e"},
        p.map_memory);
  visit(Info{"map_obstacle_height", "m", 0.01, 1,
             "lowest obstacle that must not be in a free cell: ground is free as far as the camera "
             "tells these from it"},
        p.map_obstacle_height);
  visit(Info{"map_missing_ground", "-", 0, 1, "missing ground is occupied in the map"},
        p.map_missing_ground);
  visit(Info{"box_images", "#", 1, 100,
             "images in which a thing has to be seen to be among the boxes"},
        p.box_images);
  visit(Info{"stride", "px", 1, 64, "clouds have every n-th point of every n-th row"}, p.stride);
  visit(Info{"clouds_in_base_frame", "-", 0, 1,
             "clouds are in base_frame instead of the optical frame"},
        p.clouds_in_base_frame);
  visit(Info{"coloured_clouds", "-", 0, 1,
             "clouds are XYZRGB with the colours of image, black where there is none"},
        p.coloured_clouds);
}

std::vector<std::string> findErrors(const NodeParameters& parameters);
/// @throw std::invalid_argument as `setParameter` of the detection does.
void setParameter(NodeParameters& parameters, const std::string& name, const std::string& value);

/// Sets values that contradict each other back to their defaults.
/// @return one sentence each.
std::vector<std::string> refuseContradictions(NodeParameters& parameters);

/// @return what of the obstacles the robot would touch.
ObstacleLimits obstacleLimits(const NodeParameters& parameters);

/// Reads them from a node's private namespace. What cannot be used is refused in one line of the
/// log, and the default stays.
NodeParameters loadNodeParameters(const ros::NodeHandle& private_node);

}  // namespace dominant_plane_detection
