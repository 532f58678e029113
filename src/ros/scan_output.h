#pragma once

#include <ros/node_handle.h>

#include <functional>

#include "core/ray_table.h"
#include "navigation/ground_scan.h"
#include "ros/detection_inputs.h"
#include "ros/ground_tf.h"
#include "ros/node_parameters.h"

namespace dominant_plane_detection {

/// The topic `~scan`, a planar scan in the frame on the ground, and that frame's tf, which goes out
/// with it.
class ScanOutput {
 public:
  /// @param rays shared with whoever needs those of the same images.
  ScanOutput(ros::NodeHandle& private_node, const NodeParameters& parameters, RobotFrames& frames,
             RayTable& rays, const std::function<void()>& listeners_changed);

  bool anybodyListens() const { return publisher_.getNumSubscribers() > 0 || tf_.always(); }
  /// Without a plane there is neither scan nor tf.
  /// @param range_max [m] farthest depth that was looked at.
  void publish(const DetectionInputs::Frame& frame, const Detection& detection, double range_max);

 private:
  ScanLimits limits_;
  GroundTf tf_;
  GroundScanner scanner_;
  RayTable& rays_;
  ros::Publisher publisher_;
};

}  // namespace dominant_plane_detection
