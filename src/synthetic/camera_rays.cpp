#include "synthetic/camera_rays.h"

#include <limits>
#include <opencv2/calib3d.hpp>

namespace dominant_plane_detection {
namespace {

constexpr double kMaxError = 1e-3;  // [px] between a pixel and where its ray is seen

std::vector<Eigen::Vector2f> pinholeRays(const CameraModel& camera) {
  std::vector<Eigen::Vector2f> rays;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      rays.emplace_back((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
    }
  }
  return rays;
}

std::vector<Eigen::Vector2f> distortedRays(const CameraModel& camera) {
  const cv::Matx33d matrix(camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0);
  // The same order of coefficients as OpenCV's, with zeros for those that plumb_bob does not have.
  const std::vector<double> coefficients(camera.coefficients.begin(), camera.coefficients.end());
  std::vector<cv::Point2d> pixels, undistorted, seen;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) pixels.emplace_back(u, v);
  }
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-9);
  cv::undistortPoints(pixels, undistorted, matrix, coefficients, cv::noArray(), cv::noArray(),
                      until);
  std::vector<cv::Point3d> points;
  for (const cv::Point2d& ray : undistorted) points.emplace_back(ray.x, ray.y, 1.0);
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), matrix, coefficients, seen);
  std::vector<Eigen::Vector2f> rays;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    // OpenCV returns its last guess where the iteration does not converge.
    const bool found = cv::norm(seen[i] - pixels[i]) < kMaxError;
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    rays.emplace_back(found ? Eigen::Vector2d(undistorted[i].x, undistorted[i].y).cast<float>()
                            : Eigen::Vector2f(kNone, kNone));
  }
  return rays;
}

}  // namespace

std::vector<Eigen::Vector2f> cameraRays(const CameraModel& camera) {
  return camera.distortion == DistortionModel::kNone ? pinholeRays(camera) : distortedRays(camera);
}

}  // namespace dominant_plane_detection
