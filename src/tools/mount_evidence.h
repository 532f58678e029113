#pragma once

#include <std_msgs/Header.h>
#include <tf2/buffer_core.h>

#include <vector>

#include "doctor/facts.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/prior.h"
#include "prior/mount_watch.h"
#include "ros/node_parameters.h"
#include "ros/robot_frames.h"

namespace dominant_plane_detection {

/// What a recording's tf tells of the images, and how the planes differ, as the nodelet has it.
class MountEvidence {
 public:
  MountEvidence(const NodeParameters& parameters, const tf2::BufferCore& frames)
      : parameters_(parameters), frames_(frames), watch_(parameters.base_frame) {}

  /// @return whether anything is wanted of tf.
  bool wanted() const;
  Prior priorOf(const std_msgs::Header& header);
  /// @param detection of the image that `priorOf` was last called for.
  void add(const std_msgs::Header& header, const Detection& detection);
  RobotFacts facts() const;

 private:
  NodeParameters parameters_;
  const tf2::BufferCore& frames_;
  MountWatch watch_;
  std::optional<Eigen::Isometry3d> camera_;      ///< T_base_camera at the image
  std::optional<Prior::ExpectedHeight> height_;  ///< by tf at the image
  std::string problem_;                          ///< of the last image without tf
  PoseCounts poses_;                             ///< of tf at the images
  std::size_t off_ = 0;                       ///< [#] images at the end for which the mount was off
  std::vector<double> heights_, tf_heights_;  ///< [m]
};

}  // namespace dominant_plane_detection
