#pragma once

#include <camera_info_manager/camera_info_manager.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>

#include <mutex>
#include <optional>
#include <string>

namespace dominant_plane_detection {

/// @return the calibration of a camera for images of another size (REP 104). Where the shape
/// differs, as that of 1280 x 1024 and 640 x 480, the sensor's whole width is taken to be seen, and
/// as much cut off (or added) above as below. Nothing for a calibration without a size.
std::optional<sensor_msgs::CameraInfo> scaled(const sensor_msgs::CameraInfo& info,
                                              std::uint32_t width, std::uint32_t height);

/// @return the calibration with its principal points moved.
/// @param right, down [px]
sensor_msgs::CameraInfo shifted(sensor_msgs::CameraInfo info, double right, double down);

/// A pinhole with the optical axis through the middle of the image.
/// @param field_of_view [rad] horizontal.
sensor_msgs::CameraInfo pinhole(std::uint32_t width, std::uint32_t height, double field_of_view);

/// The calibration of one camera: from a file, or else from the field of view that the device
/// reports. May be used from any thread.
class CameraCalibration {
 public:
  /// Offers `set_camera_info` in the namespace of `node`.
  /// @param name of the camera's kind, such as "depth".
  /// @param url of the file; ${NAME} in it stands for the kind and the serial number.
  CameraCalibration(const ros::NodeHandle& node, std::string name, std::string url);

  /// Another camera is open.
  /// @param field_of_view [rad] horizontal; 0 where the device does not tell: that of a Kinect is
  /// taken, with a warning.
  void setCamera(const std::string& serial, double field_of_view);

  /// @return what a file says, for images of a size, without a header; nothing where there is none.
  std::optional<sensor_msgs::CameraInfo> calibrated(std::uint32_t width, std::uint32_t height);
  /// @return the same by the field of view.
  sensor_msgs::CameraInfo uncalibrated(std::uint32_t width, std::uint32_t height);

 private:
  std::string name_;
  std::string url_;
  camera_info_manager::CameraInfoManager manager_;
  std::mutex mutex_;
  double field_of_view_ = 0.0;
  bool warned_ = false;
};

}  // namespace dominant_plane_detection
