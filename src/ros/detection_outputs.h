#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/ray_table.h"
#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/detection.h"
#include "ros/detection_inputs.h"

namespace dominant_plane_detection {

/// The topics a detection is published on. Each message is made only while somebody listens to it,
/// carries the depth image's header, and is not touched once it is published, so that subscribers
/// in the same process may keep it.
class DetectionOutputs {
 public:
  /// @param node outputs are private topics of it.
  /// @param listeners_changed called whenever somebody begins or ends to listen to any of them.
  void advertise(ros::NodeHandle& node, const std::function<void()>& listeners_changed);

  /// Ends all topics; waits for a running `listeners_changed`.
  void shutdown();

  bool anybodyListens() const;

  /// @param processing_time [s] of the detection alone.
  /// @param inputs asked for the picture under the overlay.
  void publish(const DetectionInputs::Frame& frame, const Detection& detection,
               double processing_time, const DetectionInputs& inputs);

  /// Publishes the overlay that waits for its picture, if it has come.
  void publishWaitingOverlay(const DetectionInputs& inputs);

 private:
  /// A picture may come later than the depth image that it belongs to.
  struct WaitingOverlay {
    std_msgs::Header header;
    Detection detection;
    cv::Mat grey;  ///< made from the depth, for when no picture comes until the next image
  };

  void publishClouds(const DetectionInputs::Frame& frame, const Detection& detection);
  void publishShapes(const DetectionInputs::Frame& frame, const Detection& detection);
  void prepareOverlay(const DetectionInputs::Frame& frame, const Detection& detection,
                      const DetectionInputs& inputs);
  void publishOverlay(const std::optional<cv::Mat>& picture);

  ros::Publisher plane_;
  ros::Publisher coefficients_;
  ros::Publisher obstacles_;
  ros::Publisher ground_;
  ros::Publisher outline_;
  ros::Publisher markers_;
  image_transport::Publisher mask_;
  image_transport::Publisher overlay_;
  RayTable rays_;
  std::optional<WaitingOverlay> waiting_;
};

}  // namespace dominant_plane_detection
