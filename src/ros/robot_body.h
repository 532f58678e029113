#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "prior/body_mask.h"
#include "ros/detection_inputs.h"
#include "ros/node_parameters.h"
#include "ros/robot_frames.h"

namespace dominant_plane_detection {

/// The robot's own body, by the parameter `robot_body`, which is taken out of the images.
class RobotBody {
 public:
  /// @param parameters with the frame that the boxes are in.
  /// @param rays shared with whoever needs those of the same images.
  RobotBody(const ros::NodeHandle& private_node, const NodeParameters& parameters,
            RobotFrames& frames, RayTable& rays);

  /// @return the image without the body, valid until the next call; the image itself where there is
  /// none, or nobody knows where it is, which the log says then.
  DepthView mask(const DetectionInputs::Frame& frame);

 private:
  std::string base_frame_;
  RobotFrames& frames_;
  BodyMask mask_;
  RayTable& rays_;
};

/// @param value a list of boxes, each {min: [x, y, z], max: [x, y, z]} in [m].
/// @throw std::invalid_argument that says what was expected.
std::vector<BodyMask::Box> asBoxes(XmlRpc::XmlRpcValue value);

}  // namespace dominant_plane_detection
