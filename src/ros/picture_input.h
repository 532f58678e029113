#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>

#include <deque>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

namespace dominant_plane_detection {

/// Pictures that are registered to the depth image: in its frame, as depth registration gives them.
/// They are subscribed while they are wanted and can be used.
///
/// All of it happens in the thread of the node's callback queue.
class PictureInput {
 public:
  /// What there is of an image's time.
  struct Found {
    bool there = false;  ///< nothing more is to be waited for
    /// 8 bits, of the image's size, not to be written to; nothing where it is of no use
    std::optional<cv::Mat> bgr;
  };

  /// @param node pictures come on a topic relative to it.
  /// @param private_node has `image_transport`.
  /// @param on_picture called when one has come.
  PictureInput(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
               std::function<void()> on_picture)
      : private_node_(private_node), transport_(node), on_picture_(std::move(on_picture)) {}

  /// @throw image_transport::Exception when `image_transport` names none.
  void follow(bool wanted);
  /// For each depth image: in another frame, pictures may be of use again.
  void beginImage(const std::string& frame_id);
  /// @return whether somebody sends pictures that can be used.
  bool mayCome() const { return pictures_ && pictures_.getNumPublishers() > 0; }

  /// @param header of the depth image.
  /// @param tolerance [s] that the picture may be from another time: half an image at 30 Hz.
  Found find(const std_msgs::Header& header, int width, int height, double tolerance = 1.0 / 60.0);

 private:
  void onPicture(const sensor_msgs::ImageConstPtr& picture);
  void end();
  sensor_msgs::ImageConstPtr nearest(const ros::Time& stamp, double tolerance) const;
  std::optional<cv::Mat> read(const sensor_msgs::Image& picture, int width, int height) const;

  ros::NodeHandle private_node_;
  image_transport::ImageTransport transport_;
  std::function<void()> on_picture_;
  image_transport::Subscriber pictures_;
  std::deque<sensor_msgs::ImageConstPtr> recent_;
  sensor_msgs::ImageConstPtr read_;  ///< the picture that was read last, and what it gave
  std::optional<cv::Mat> bgr_;
  bool wanted_ = false;
  /// Frame of depth images for which pictures are of no use; they are not subscribed meanwhile.
  std::string unregistered_frame_;
};

}  // namespace dominant_plane_detection
