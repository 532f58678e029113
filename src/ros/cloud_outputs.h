#pragma once

#include <ros/node_handle.h>

#include <array>
#include <functional>

#include "core/ray_table.h"
#include "dominant_plane_detection/detection.h"
#include "ros/detection_inputs.h"
#include "ros/node_parameters.h"
#include "ros/picture_input.h"
#include "ros/robot_frames.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {

/// The clouds of obstacles, ground, drop-offs and missing ground.
class CloudOutputs {
 public:
  /// @param rays shared with whoever needs those of the same images.
  CloudOutputs(ros::NodeHandle& private_node, const NodeParameters& parameters, RobotFrames& frames,
               PictureInput& pictures, RayTable& rays,
               const std::function<void()>& listeners_changed);

  bool anybodyListens() const;
  /// @return whether pictures are wanted for their colours.
  bool wantPictures() const { return parameters_.coloured_clouds && anybodyListens(); }
  void publish(const DetectionInputs::Frame& frame, const Detection& detection);

 private:
  /// The points of the pixels with a label.
  struct LabelledCloud {
    const char* topic;
    Label label;
    ros::Publisher publisher;
  };

  NodeParameters parameters_;
  RobotFrames& frames_;
  PictureInput& pictures_;
  std::array<LabelledCloud, 4> clouds_{{{topics::kObstacles, Label::kObstacle, {}},
                                        {topics::kGround, Label::kGround, {}},
                                        {topics::kDropOffs, Label::kDropOff, {}},
                                        {topics::kMissingGround, Label::kMissingGround, {}}}};
  RayTable& rays_;
};

}  // namespace dominant_plane_detection
