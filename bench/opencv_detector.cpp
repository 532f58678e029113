#include <opencv2/core.hpp>
#include <opencv2/rgbd.hpp>

#include "other_detectors.h"

namespace dominant_plane_detection {
OpenCvPlane::OpenCvPlane(const CameraModel& camera)
    : k_((cv::Mat_<float>(3, 3) << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1)) {}

cv::Mat OpenCvPlane::points(const cv::Mat& depth) const {
  cv::Mat points;
  cv::rgbd::depthTo3d(depth, k_, points);
  return points;
}

cv::Mat OpenCvPlane::segment(const cv::Mat& points) const {
  cv::rgbd::RgbdPlane detector;
  cv::Mat mask;
  std::vector<cv::Vec4f> coefficients;
  detector(points, mask, coefficients);
  return mask;
}

cv::Mat OpenCvPlane::detect(const cv::Mat& depth) const {
  const cv::Mat cloud = points(depth);
  const cv::rgbd::RgbdNormals estimate(depth.rows, depth.cols, CV_32F, k_, 5,
                                       cv::rgbd::RgbdNormals::RGBD_NORMALS_METHOD_FALS);
  cv::Mat normals, mask;
  estimate(cloud, normals);
  std::vector<cv::Vec4f> coefficients;
  cv::rgbd::RgbdPlane detector;
  detector(cloud, normals, mask, coefficients);
  return mask;
}

}  // namespace dominant_plane_detection
