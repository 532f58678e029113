#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "openni2/camera_device.h"
#include "ros/camera_calibration.h"

namespace dominant_plane_detection {

/// Names that users give to what the driver publishes.
struct DriverNames {
  std::string depth_frame_id = "camera_depth_optical_frame";  ///< of depth and infrared images
  std::string rgb_frame_id = "camera_rgb_optical_frame";  ///< of colour images, registered depth
  std::string depth_camera_info_url;
  std::string rgb_camera_info_url;
  std::string ir_camera_info_url;
  /// [px] of 640 columns: a point is seen so much farther to the right, and down, in the infrared
  /// image than in the depth image, which has lost a margin to the matching of the pattern.
  double depth_ir_offset_x = 5.0;
  double depth_ir_offset_y = 4.0;
};

/// The topics that a camera's images are published on, each with the camera_info of its stamp.
class DriverOutputs {
 public:
  /// @param node topics are relative to it.
  /// @param listeners_changed called whenever somebody begins or ends to listen to any of them.
  void advertise(const ros::NodeHandle& node, const DriverNames& names,
                 const std::function<void()>& listeners_changed);

  /// @return whether somebody listens to the images of a stream, on any topic.
  bool wants(StreamKind kind) const;
  bool wantsImu() const { return imu_.getNumSubscribers() > 0; }
  bool wantsRawDisparity() const { return disparity_.getNumSubscribers() > 0; }

  /// Another camera is open.
  void setCamera(const CameraDevice& camera);

  /// Publishes without a copy: the message must not be touched any more.
  /// @param registered depth as seen from the colour camera.
  void publish(StreamKind kind, bool registered, const sensor_msgs::ImagePtr& image,
               const ros::Time& stamp);
  /// The same.
  void publishRawDisparity(const sensor_msgs::ImagePtr& raw, const ros::Time& stamp);
  /// REP 145: what is not measured is marked so.
  void publish(const openni2_plugin::Acceleration& acceleration, const ros::Time& stamp);

 private:
  void publishProjector(const sensor_msgs::Image& depth);
  sensor_msgs::CameraInfo cameraInfo(StreamKind kind, std::uint32_t width, std::uint32_t height);
  CameraCalibration& calibration(StreamKind kind) { return *calibrations_[static_cast<int>(kind)]; }

  DriverNames names_;
  std::unique_ptr<CameraCalibration> calibrations_[kStreamKinds];
  image_transport::CameraPublisher streams_[kStreamKinds];
  image_transport::CameraPublisher registered_;
  ros::Publisher disparity_;
  ros::Publisher projector_;
  ros::Publisher imu_;
  std::atomic<double> baseline_{0.0};  ///< [m] from the depth camera to its projector
};

}  // namespace dominant_plane_detection
