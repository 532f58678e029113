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

/// @param isOn whether a pixel (u, v) is the plane's.
/// @return the outermost pixels of each row: their hull is that of all.
template <typename IsOn>
std::vector<Eigen::Vector2i> rowEnds(const Detection& detection, IsOn&& isOn) {
  std::vector<Eigen::Vector2i> ends;
  for (int v = 0; v < detection.image_height; ++v) {
    int left = 0;
    int right = detection.image_width - 1;
    while (left <= right && !isOn(left, v)) ++left;
    while (right > left && !isOn(right, v)) --right;
    if (left > right) continue;
    ends.emplace_back(left, v);
    ends.emplace_back(right, v);
  }
  return ends;
}

std::vector<Eigen::Vector3d> outlineOf(const Eigen::Vector3d& normal, double distance,
                                       const std::vector<Eigen::Vector2i>& pixels,
                                       const RayTable& rays) {
  const Basis basis(normal);
  const Eigen::Vector3d origin = -distance * normal;
  std::vector<cv::Point2f> flat;
  for (const Eigen::Vector2i& pixel : pixels) {
    const Eigen::Vector3d ray = rays.ray(pixel.x(), pixel.y()).cast<double>();
    const double fall = -normal.dot(ray);
    if (!(fall >= 1e-6)) continue;  // along the plane, or an unknown ray: never meets it
    const Eigen::Vector3d point = distance / fall * ray - origin;
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

}  // namespace

std::vector<Eigen::Vector3d> groundOutline(const Detection& detection, const RayTable& rays) {
  if (!detection.found()) return {};
  const auto pixels = rowEnds(detection, [&](int u, int v) { return detection.onPlane(u, v); });
  return outlineOf(detection.normal, detection.distance, pixels, rays);
}

std::vector<std::vector<Eigen::Vector3d>> furtherOutlines(const Detection& detection,
                                                          const RayTable& rays) {
  std::vector<std::vector<Eigen::Vector3d>> outlines;
  std::uint8_t number = 1;  // the dominant plane's
  for (const FurtherPlane& plane : detection.further_planes) {
    ++number;
    const auto pixels = rowEnds(detection, [&](int u, int v) {
      return detection.plane_index[detection.indexOf(u, v)] == number;
    });
    outlines.push_back(outlineOf(plane.normal, plane.distance, pixels, rays));
  }
  return outlines;
}

}  // namespace dominant_plane_detection
