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
  if (info.width == 0 || info.height == 0 || width == 0 || height == 0) return std::nullopt;
  sensor_msgs::CameraInfo result = info;
  const double scale = static_cast<double>(width) / info.width;
  // Pixel centres are whole numbers: the image's edge is half a pixel before the first one.
  const auto column = [scale](double c) { return (c + 0.5) * scale - 0.5; };
  const double cut = 0.5 * (scale * info.height - height);  // rows above, and below
  const auto row = [&](double c) { return column(c) - cut; };
  result.width = width;
  result.height = height;
  result.K[0] *= scale;
  result.K[2] = column(info.K[2]);
  result.K[4] *= scale;
  result.K[5] = row(info.K[5]);
  result.P[0] *= scale;
  result.P[2] = column(info.P[2]);
  result.P[3] *= scale;
  result.P[5] *= scale;
  result.P[6] = row(info.P[6]);
  result.P[7] *= scale;
  return result;
}

sensor_msgs::CameraInfo shifted(sensor_msgs::CameraInfo info, double right, double down) {
  for (double* const x : {&info.K[2], &info.P[2]}) *x += right;
  for (double* const y : {&info.K[5], &info.P[6]}) *y += down;
  return info;
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

std::optional<sensor_msgs::CameraInfo> CameraCalibration::calibrated(std::uint32_t width,
                                                                     std::uint32_t height) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!manager_.isCalibrated()) return std::nullopt;
  const sensor_msgs::CameraInfo calibration = manager_.getCameraInfo();
  const bool same_shape =
      std::uint64_t{calibration.width} * height == std::uint64_t{width} * calibration.height;
  if (!same_shape && !warned_) {
    warned_ = true;
    ROS_WARN_STREAM("The calibration of the "
                    << name_ << " camera is for " << calibration.width << " x "
                    << calibration.height << " pixels, its images have " << width << " x " << height
                    << ", which is another shape: the whole width is taken to be seen, and as much "
                       "cut off above as below.");
  }
  return scaled(calibration, width, height);
}

sensor_msgs::CameraInfo CameraCalibration::uncalibrated(std::uint32_t width, std::uint32_t height) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return pinhole(width, height, field_of_view_ > 0.0 ? field_of_view_ : kKinectFieldOfView);
}

}  // namespace dominant_plane_detection
