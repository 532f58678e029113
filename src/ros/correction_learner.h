#pragma once

#include <ros/node_handle.h>
#include <ros/time.h>

#include <future>
#include <string>

#include "calibration/floor_correction.h"
#include "ros/detection_inputs.h"

namespace dominant_plane_detection {

/// Learns a camera's fixed error while the node runs, where the parameter `learn_correction` names
/// a file to write: one image a second, anew after every minute of them, for ten minutes.
///
/// Called in the thread of the node's callback queue; the arithmetic, up to some seconds, is
/// done by a copy in a thread of its own, which the destructor waits for.
class CorrectionLearner {
 public:
  /// @param corrected whether images come corrected already: nothing is learned then, which the log
  /// says.
  CorrectionLearner(const ros::NodeHandle& node, const NoiseModel& noise, bool corrected);

  /// @return whether images are wanted although nobody listens to the node.
  bool wants() const { return !file_.empty(); }
  void add(const DetectionInputs::Frame& frame, const Detection& detection);

 private:
  void begin();

  std::string file_;  ///< empty: nothing is learned, or no more
  FloorCorrection correction_;
  ros::Time last_;                ///< of an image that was taken
  std::size_t learned_from_ = 0;  ///< [#] images
  std::future<void> learning_;
};

}  // namespace dominant_plane_detection
