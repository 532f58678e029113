#pragma once

#include <image_transport/image_transport.h>
#include <pcl_ros/point_cloud.h>
#include <ros/node_handle.h>

#include <deque>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"
#include "ros/camera_info_matcher.h"
#include "ros/cloud_conversion.h"
#include "ros/depth_conversion.h"

namespace dominant_plane_detection {

/// Where depth comes from.
enum class InputKind : std::uint8_t {
  kDepth,   ///< depth/image_raw and its camera_info
  kPoints,  ///< points, an organised cloud
};

/// Subscribes to the topics that depth comes from, and hands on what can be looked at. What cannot
/// is dropped with one throttled line that says what was expected and what came.
class DetectionInputs {
 public:
  struct Frame {
    std_msgs::Header header;
    DepthView depth;  ///< valid during the call
    CameraModel camera;
  };
  using Callback = std::function<void(const Frame&)>;
  using PictureCallback = std::function<void()>;

  /// @param node topics are relative to it.
  /// @param rectified whether depth images are; clouds and their cameras say it themselves.
  /// @param picture_callback called when there is a new picture.
  DetectionInputs(const ros::NodeHandle& node, InputKind kind, bool rectified, Callback callback,
                  PictureCallback picture_callback);

  void subscribe();
  void unsubscribe();
  bool subscribed() const { return subscribed_; }

  /// @return whether somebody publishes pictures, so that one may still come.
  bool expectsPictures() const { return pictures_.getNumPublishers() > 0; }
  /// @return the picture that belongs to a depth image: 8-bit BGR of its size, of a stamp less than
  /// half an image's time away; nothing if there is none.
  std::optional<cv::Mat> picture(const std_msgs::Header& header, int width, int height) const;

 private:
  void onImage(const sensor_msgs::ImageConstPtr& image);
  void onInfo(const sensor_msgs::CameraInfoConstPtr& info);
  void onPair(const std::optional<CameraInfoMatcher::Pair>& pair);
  void onPoints(const boost::shared_ptr<const pcl::PointCloud<pcl::PointXYZ>>& cloud);
  void onPicture(const sensor_msgs::ImageConstPtr& picture);
  void warnOfSilence();

  ros::NodeHandle node_;
  image_transport::ImageTransport transport_;
  InputKind kind_;
  bool rectified_;
  Callback callback_;
  PictureCallback picture_callback_;

  bool subscribed_ = false;
  bool received_ = false;       ///< anything since the subscription
  bool warned_stamps_ = false;  ///< of camera_info with other stamps
  image_transport::Subscriber images_;
  image_transport::Subscriber pictures_;
  ros::Subscriber infos_;
  ros::Subscriber points_;
  ros::WallTimer silence_;

  CameraInfoMatcher matcher_;
  DepthReader depth_reader_;
  CloudReader cloud_reader_;
  std::deque<sensor_msgs::ImageConstPtr> recent_pictures_;
};

}  // namespace dominant_plane_detection
