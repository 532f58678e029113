#pragma once

#include <dominant_plane_detection/DominantPlane.h>
#include <sensor_msgs/Image.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "dominant_plane_detection/camera_model.h"
#include "support/driver_test.h"
#include "support/ros_test.h"

namespace dominant_plane_detection {

constexpr const char* kCalibrations = DPD_SOURCE "/config/depth_calibration/";

/// Writes a calibration file for the driver. @return its URL.
inline std::string writeCameraInfo(const std::string& folder, const CameraModel& camera) {
  const std::string file = folder + "/camera.yaml";
  std::ofstream out(file);
  const auto matrix = [&](const char* name, int cols, const std::string& extra) {
    out << name << ": {rows: 3, cols: " << cols << ", data: [" << camera.fx << ", 0, " << camera.cx
        << extra << ", 0, " << camera.fy << ", " << camera.cy << extra << ", 0, 0, 1" << extra
        << "]}\n";
  };
  out << "image_width: " << camera.width << "\nimage_height: " << camera.height
      << "\ncamera_name: depth\n";
  matrix("camera_matrix", 3, "");
  out << "distortion_model: plumb_bob\n"
         "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"
         "rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}\n";
  matrix("projection_matrix", 4, ", 0");
  return "file://" + file;
}

/// What the driver and the detection made of one image of a Kinect.
struct ChainResult {
  sensor_msgs::ImageConstPtr depth;
  DominantPlaneConstPtr plane;
  sensor_msgs::ImageConstPtr overlay;
};

/// A Kinect's recording through libfreenect, the plug-in, OpenNI2, the driver nodelet in raw mode
/// and the detection, in this process.
class KinectChain {
 public:
  /// @param images raw disparity of the recording; results are told apart by it.
  explicit KinectChain(std::vector<cv::Mat> images) : images_(std::move(images)) {}

  /// @param calibration file in config/depth_calibration.
  /// @param overlays whether overlays are asked for.
  /// @return whether each image of the recording has come out at the other end.
  bool run(const std::string& calibration, const std::string& camera_info_url, bool overlays) {
    results_.assign(images_.size(), {});
    ros::NodeHandle node("/camera");
    if (!manager_.loadDriver("/camera", "freenect",
                             {{"raw_disparity", "true"},
                              {"depth_calibration", kCalibrations + calibration},
                              {"depth_camera_info_url", camera_info_url}}) ||
        !manager_.loadDetection("/camera")) {
      return false;
    }
    bool complete = false;
    {
      Listener<sensor_msgs::Image> raw(node, "depth/disparity_raw");
      Listener<sensor_msgs::Image> depth(node, "depth/image_raw");
      Listener<DominantPlane> planes(node, "plane_detection/plane");
      std::optional<Listener<sensor_msgs::Image>> overlay;
      if (overlays) overlay.emplace(node, "plane_detection/overlay");
      complete = spinUntil(
          [&] {
            assign(raw.messages(), depth.messages(), planes.messages());
            if (overlay) assignOverlays(overlay->messages());
            return isComplete(overlays);
          },
          60.0);
    }
    manager_.unload("/camera/plane_detection");
    manager_.unload("/camera/driver");
    return complete;
  }

  /// In the order of the recording.
  const std::vector<ChainResult>& results() const { return results_; }

 private:
  template <typename Messages>
  static typename Messages::value_type withStamp(const Messages& messages, const ros::Time& stamp) {
    for (const auto& message : messages) {
      if (message->header.stamp == stamp) return message;
    }
    return nullptr;
  }

  template <typename Images, typename Planes>
  void assign(const Images& raw, const Images& depth, const Planes& planes) {
    for (; assigned_ < raw.size(); ++assigned_) {
      const std::size_t i = indexOf(*raw[assigned_]);
      stamps_[raw[assigned_]->header.stamp] = i;
    }
    for (const auto& [stamp, i] : stamps_) {
      if (i == images_.size() || results_[i].plane) continue;
      const auto image = withStamp(depth, stamp);
      const auto plane = withStamp(planes, stamp);
      if (image && plane) results_[i] = {image, plane, nullptr};
    }
  }

  template <typename Images>
  void assignOverlays(const Images& overlays) {
    for (ChainResult& result : results_) {
      if (result.plane && !result.overlay) {
        result.overlay = withStamp(overlays, result.plane->header.stamp);
      }
    }
  }

  bool isComplete(bool overlays) const {
    for (const ChainResult& result : results_) {
      if (!result.plane || (overlays && !result.overlay)) return false;
    }
    return true;
  }

  /// @return which image of the recording it is, byte by byte; their number for none.
  std::size_t indexOf(const sensor_msgs::Image& raw) const {
    for (std::size_t i = 0; i < images_.size(); ++i) {
      const std::size_t bytes = images_[i].total() * images_[i].elemSize();
      if (raw.data.size() == bytes && std::memcmp(raw.data.data(), images_[i].data, bytes) == 0) {
        return i;
      }
    }
    ADD_FAILURE() << "an image that is not in the recording";
    return images_.size();
  }

  std::vector<cv::Mat> images_;
  std::vector<ChainResult> results_;
  std::map<ros::Time, std::size_t> stamps_;
  std::size_t assigned_ = 0;
  Manager manager_;
};

/// [rad] between two directions.
inline double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

inline Eigen::Vector3d normalOf(const DominantPlane& plane) {
  return {plane.normal.x, plane.normal.y, plane.normal.z};
}

}  // namespace dominant_plane_detection
