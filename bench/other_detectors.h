#pragma once

#include <opencv2/core/mat.hpp>

#include "dominant_plane_detection/camera_model.h"

namespace dominant_plane_detection {

/// Published plane detectors on a depth image in metres (32-bit, NaN for no reading), each with the
/// defaults of its library. What they return only keeps the compiler from leaving them out.

/// OpenCV's RgbdPlane on points that are there already: the plane segmentation alone.
class OpenCvPlane {
 public:
  OpenCvPlane(const CameraModel& camera);
  /// Depth to points, for `segment`.
  cv::Mat points(const cv::Mat& depth) const;
  int segment(const cv::Mat& points) const;
  /// From depth to planes, with normals, as in OpenCV's sample.
  int detect(const cv::Mat& depth) const;

 private:
  cv::Mat k_;
};

/// PCL's OrganizedMultiPlaneSegmentation with normals from integral images.
int detectWithPclOrganized(const cv::Mat& depth, const CameraModel& camera);

/// PCL's RANSAC on every second point of every second row, 2 cm, 200 iterations.
int detectWithPclRansac(const cv::Mat& depth, const CameraModel& camera);

}  // namespace dominant_plane_detection
