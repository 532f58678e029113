#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "dominant_plane_detection/detection.h"
#include "ros/detection_inputs.h"
#include "ros/picture_input.h"

namespace dominant_plane_detection {

/// The topic `~overlay`: the picture with the ground painted black; a grey picture of the depth
/// where there is none that can be used.
///
/// All of it happens in the thread of the node's callback queue.
class OverlayOutput {
 public:
  /// @param private_node the overlay is a private topic of it.
  /// @param pictures outlives this.
  /// @param listeners_changed called whenever somebody begins or ends to listen.
  OverlayOutput(const ros::NodeHandle& private_node, PictureInput& pictures,
                const std::function<void()>& listeners_changed);

  bool anybodyListens() const { return publisher_.getNumSubscribers() > 0; }

  /// Publishes the overlay of an image: at once where its picture is there or none will come, and
  /// otherwise with its picture, before the next one at the latest.
  void publish(const DetectionInputs::Frame& frame, const Detection& detection);
  /// A picture has come.
  void onPicture();
  /// Somebody may have ended to listen: what waits is nobody's then.
  void followListeners() {
    if (!anybodyListens()) waiting_.reset();
  }

 private:
  /// A picture may come later than the depth image that it belongs to.
  struct Waiting {
    std_msgs::Header header;
    Detection detection;
    cv::Mat grey;  ///< made from the depth, for when no picture comes until the next image
  };

  bool tryPicture();
  void publishWaiting(const std::optional<cv::Mat>& picture);

  PictureInput& pictures_;
  image_transport::Publisher publisher_;
  std::optional<Waiting> waiting_;
};

}  // namespace dominant_plane_detection
