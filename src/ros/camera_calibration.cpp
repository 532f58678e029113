#include "ros/camera_calibration.h"

#include <ros/console.h>
#include <sensor_msgs/distortion_models.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace dominant_plane_detection {
namespace {

constexpr double kKinectFieldOfView = 1.0145;  // [rad] as PrimeSense devices report

/// @return the file that camera_info_manager takes when no URL is given.
std::filesystem::path defaultFile(const std::string& camera_name) {
  const char* ros_home = std::getenv("ROS_HOME");
  const char* home = std::getenv("HOME");
  const std::filesystem::path folder =
      ros_home != nullptr ? ros_home : std::filesystem::path(home != nullptr ? home : ".") / ".ros";
  return folder / "camera_info" / (camera_name + ".yaml");
}

}  // namespace

std::optional<sensor_msgs::CameraInfo> scaled(const sensor_msgs::CameraInfo& info,
                                              std::uint32_t width, std::uint32_t height) {
  const std::uint64_t across = std::uint64_t{info.width} * height;
  if (info.width == 0 || across != std::uint64_t{width} * info.height) return std::nullopt;
  sensor_msgs::CameraInfo result = info;
  const double scale = static_cast<double>(width) / info.width;
  // Pixel centres are whole numbers: the image's edge is half a pixel before the first one.
  const auto centre = [scale](double c) { return (c + 0.5) * scale - 0.5; };
  result.width = width;
  result.height = height;
  result.K[0] *= scale;
  result.K[2] = centre(info.K[2]);
  result.K[4] *= scale;
  result.K[5] = centre(info.K[5]);
  result.P[0] *= scale;
  result.P[2] = centre(info.P[2]);
  result.P[3] *= scale;
  result.P[5] *= scale;
  result.P[6] = centre(info.P[6]);
  result.P[7] *= scale;
  return result;
}

sensor_msgs::CameraInfo pinhole(std::uint32_t width, std::uint32_t height, double field_of_view) {
  const double f = 0.5 * width / std::tan(0.5 * field_of_view);
  const double cx = 0.5 * width - 0.5;
  const double cy = 0.5 * height - 0.5;
  sensor_msgs::CameraInfo info;
  info.width = width;
  info.height = height;
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(5, 0.0);
  info.K = {f, 0.0, cx, 0.0, f, cy, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {f, 0.0, cx, 0.0, 0.0, f, cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

CameraCalibration::CameraCalibration(const ros::NodeHandle& node, std::string name, std::string url)
    : name_(std::move(name)), url_(std::move(url)), manager_(node) {}

void CameraCalibration::setCamera(const std::string& serial, double field_of_view) {
  const std::lock_guard<std::mutex> lock(mutex_);
  warned_ = false;
  field_of_view_ = field_of_view;
  if (!(0.0 < field_of_view && field_of_view < 3.1)) {
    field_of_view_ = kKinectFieldOfView;
    ROS_WARN_STREAM("The camera does not tell the field of view of its " << name_
                                                                         << " images; that of a "
                                                                            "Kinect is taken.");
  }
  const std::string camera_name = serial.empty() ? name_ : name_ + "_" + serial;
  manager_.setCameraName(camera_name);
  std::error_code error;
  if (url_.empty() && !std::filesystem::exists(defaultFile(camera_name), error)) {
    // Asked to load it, the manager would warn, though nobody has said that there is one.
    manager_.setCameraInfo(sensor_msgs::CameraInfo());
  } else {
    manager_.loadCameraInfo(url_);
  }
}

sensor_msgs::CameraInfo CameraCalibration::info(std::uint32_t width, std::uint32_t height) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (manager_.isCalibrated()) {
    const sensor_msgs::CameraInfo calibration = manager_.getCameraInfo();
    const auto fitting = scaled(calibration, width, height);
    if (fitting) return *fitting;
    if (!warned_) {
      warned_ = true;
      ROS_WARN_STREAM("The calibration of the "
                      << name_ << " camera is for " << calibration.width << " x "
                      << calibration.height << " pixels, its images have " << width << " x "
                      << height << ", which is another shape; the field of view is used instead.");
    }
  }
  return pinhole(width, height, field_of_view_ > 0.0 ? field_of_view_ : kKinectFieldOfView);
}

}  // namespace dominant_plane_detection
