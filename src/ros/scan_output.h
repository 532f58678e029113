#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <string>

#include "core/ray_table.h"
#include "navigation/ground_scan.h"
#include "ros/detection_inputs.h"
#include "ros/node_parameters.h"

namespace dominant_plane_detection {

/// The topic `~scan`, a planar scan in the frame on the ground.
class ScanOutput {
 public:
  /// @param rays shared with whoever needs those of the same images.
  ScanOutput(ros::NodeHandle& private_node, const NodeParameters& parameters, RayTable& rays,
             const std::function<void()>& listeners_changed);

  bool anybodyListens() const { return publisher_.getNumSubscribers() > 0; }
  /// @param ground_frame on the ground now (`GroundTf`); without one, as without a plane, there is
  /// no scan.
  /// @param range_max [m] farthest depth that was looked at.
  void publish(const DetectionInputs::Frame& frame, const Detection& detection,
               const std::optional<std::string>& ground_frame, double range_max);

 private:
  ScanLimits limits_;
  GroundScanner scanner_;
  RayTable& rays_;
  ros::Publisher publisher_;
};

}  // namespace dominant_plane_detection
