#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "dominant_plane_detection/camera_model.h"

namespace dominant_plane_detection {

/// Published plane detectors on a depth image in metres (32-bit, NaN for no reading), each with the
/// defaults of its library.

/// OpenCV's RgbdPlane on points that are there already: the plane segmentation alone.
class OpenCvPlane {
 public:
  OpenCvPlane(const CameraModel& camera);
  /// Depth to points, for `segment`.
  cv::Mat points(const cv::Mat& depth) const;
  /// @return 8-bit, the number of each pixel's plane, 255 for none.
  cv::Mat segment(const cv::Mat& points) const;
  /// From depth to planes, with normals, as in OpenCV's sample.
  cv::Mat detect(const cv::Mat& depth) const;

 private:
  cv::Mat k_;
};

/// PCL's OrganizedMultiPlaneSegmentation with normals from integral images.
/// @return how many planes there are.
int detectWithPclOrganized(const cv::Mat& depth, const CameraModel& camera);
/// @return 8-bit, 255 where the plane with most pixels is.
cv::Mat largestWithPclOrganized(const cv::Mat& depth, const CameraModel& camera);

/// PCL's RANSAC on every second point of every second row, 2 cm, 200 iterations.
/// @return the plane (normal, d): normal . r + d = 0.
Eigen::Vector4f detectWithPclRansac(const cv::Mat& depth, const CameraModel& camera);

}  // namespace dominant_plane_detection
