#include "ros/ground_outline.h"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

namespace dominant_plane_detection {
namespace {

/// Two axes of the plane.
struct Basis {
  explicit Basis(const Eigen::Vector3d& normal)
      : first(normal.unitOrthogonal()), second(normal.cross(first)) {}
  Eigen::Vector3d first, second;
};

/// @return the outermost ground pixels of each row: their hull is that of all.
std::vector<Eigen::Vector2i> rowEnds(const Detection& detection) {
  std::vector<Eigen::Vector2i> ends;
  for (int v = 0; v < detection.image_height; ++v) {
    int left = 0;
    int right = detection.image_width - 1;
    while (left <= right && detection.label(left, v) != Label::kGround) ++left;
    while (right > left && detection.label(right, v) != Label::kGround) --right;
    if (left > right) continue;
    ends.emplace_back(left, v);
    ends.emplace_back(right, v);
  }
  return ends;
}

}  // namespace

std::vector<Eigen::Vector3d> groundOutline(const Detection& detection, const RayTable& rays) {
  if (!detection.found()) return {};
  const Basis basis(detection.normal);
  const Eigen::Vector3d origin = -detection.distance * detection.normal;
  std::vector<cv::Point2f> flat;
  for (const Eigen::Vector2i& pixel : rowEnds(detection)) {
    const Eigen::Vector3d ray = rays.ray(pixel.x(), pixel.y()).cast<double>();
    const double fall = -detection.normal.dot(ray);
    if (fall < 1e-6) continue;  // along the plane, never meets it
    const Eigen::Vector3d point = detection.distance / fall * ray - origin;
    flat.emplace_back(static_cast<float>(point.dot(basis.first)),
                      static_cast<float>(point.dot(basis.second)));
  }
  if (flat.size() < 3) return {};
  std::vector<cv::Point2f> hull;
  cv::convexHull(flat, hull);
  if (hull.size() < 3) return {};
  std::vector<Eigen::Vector3d> outline;
  for (const cv::Point2f& corner : hull) {
    outline.emplace_back(origin + static_cast<double>(corner.x) * basis.first +
                         static_cast<double>(corner.y) * basis.second);
  }
  return outline;
}

}  // namespace dominant_plane_detection
