#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <functional>

#include "core/ray_table.h"
#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/detection.h"
#include "ros/detection_inputs.h"

namespace dominant_plane_detection {

/// The topics a detection is published on, but for overlay, clouds and scan. Each message is made
/// only while somebody listens to it, carries the depth image's header, and is not touched once it
/// is published, so that subscribers in the same process may keep it.
class DetectionOutputs {
 public:
  /// @param rays shared with whoever needs those of the same images.
  explicit DetectionOutputs(RayTable& rays) : rays_(rays) {}

  /// @param node outputs are private topics of it.
  /// @param listeners_changed called whenever somebody begins or ends to listen to any of them.
  void advertise(ros::NodeHandle& node, const std::function<void()>& listeners_changed);

  bool anybodyListens() const;

  /// @param processing_time [s] of the detection alone.
  void publish(const DetectionInputs::Frame& frame, const Detection& detection,
               double processing_time);

 private:
  void publishImages(const DetectionInputs::Frame& frame, const Detection& detection);
  void publishShapes(const DetectionInputs::Frame& frame, const Detection& detection);

  ros::Publisher plane_;
  ros::Publisher planes_;
  ros::Publisher coefficients_;
  ros::Publisher obstacle_indices_;
  ros::Publisher outline_;
  ros::Publisher markers_;
  image_transport::Publisher mask_;
  image_transport::Publisher labels_;
  image_transport::Publisher plane_index_;
  image_transport::Publisher height_image_;
  RayTable& rays_;
};

}  // namespace dominant_plane_detection
