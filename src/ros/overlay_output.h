#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>

#include <deque>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "dominant_plane_detection/detection.h"
#include "ros/detection_inputs.h"

namespace dominant_plane_detection {

/// The topic `~overlay`: the picture with the ground painted black. Pictures are subscribed while
/// somebody listens to it and they can be used: they have to be in the frame of the depth image, as
/// registered ones are; instead of any other there is a grey picture of the depth.
///
/// All of it happens in the thread of the node's callback queue.
class OverlayOutput {
 public:
  /// @param node pictures come on a topic relative to it.
  /// @param private_node has `image_transport`; the overlay is a private topic of it.
  /// @param listeners_changed called whenever somebody begins or ends to listen.
  OverlayOutput(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                const std::function<void()>& listeners_changed);

  bool anybodyListens() const { return publisher_.getNumSubscribers() > 0; }
  /// Subscribes the pictures or ends that, as listeners want it now.
  /// @throw image_transport::Exception when `image_transport` names none.
  void followListeners();

  /// Publishes the overlay of an image: at once where its picture is there or none will come, and
  /// otherwise with its picture, before the next one at the latest.
  void publish(const DetectionInputs::Frame& frame, const Detection& detection);

 private:
  /// A picture may come later than the depth image that it belongs to.
  struct Waiting {
    std_msgs::Header header;
    Detection detection;
    cv::Mat grey;  ///< made from the depth, for when no picture comes until the next image
  };

  void onPicture(const sensor_msgs::ImageConstPtr& picture);
  void endPictures();
  sensor_msgs::ImageConstPtr pictureOfWaiting() const;
  std::optional<cv::Mat> readPicture(const sensor_msgs::Image& picture) const;
  bool tryPicture();
  void publishWaiting(const std::optional<cv::Mat>& picture);

  ros::NodeHandle private_node_;
  image_transport::ImageTransport transport_;
  image_transport::Publisher publisher_;
  image_transport::Subscriber pictures_;
  std::deque<sensor_msgs::ImageConstPtr> recent_;
  std::optional<Waiting> waiting_;
  /// Frame of depth images for which pictures are of no use; they are not subscribed meanwhile.
  std::string unregistered_frame_;
};

}  // namespace dominant_plane_detection
