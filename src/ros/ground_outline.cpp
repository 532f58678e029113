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

/// The pixels of a plane: those with a value.
struct PlanePixels {
  const std::vector<std::uint8_t>& image;
  std::uint8_t value;
  int width, height;  ///< [px]

  bool at(int u, int v) const {
    return image[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(u)] == value;
  }
};

/// @return the outermost pixels of each row: their hull is that of all.
std::vector<Eigen::Vector2i> rowEnds(const PlanePixels& pixels) {
  std::vector<Eigen::Vector2i> ends;
  for (int v = 0; v < pixels.height; ++v) {
    int left = 0;
    int right = pixels.width - 1;
    while (left <= right && !pixels.at(left, v)) ++left;
    while (right > left && !pixels.at(right, v)) --right;
    if (left > right) continue;
    ends.emplace_back(left, v);
    ends.emplace_back(right, v);
  }
  return ends;
}

std::vector<Eigen::Vector3d> outlineOf(const Eigen::Vector3d& normal, double distance,
                                       const PlanePixels& pixels, const RayTable& rays) {
  const Basis basis(normal);
  const Eigen::Vector3d origin = -distance * normal;
  std::vector<cv::Point2f> flat;
  for (const Eigen::Vector2i& pixel : rowEnds(pixels)) {
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
  // Ramps are ground, but not on the plane.
  const bool numbered = !detection.plane_index.empty();
  const PlanePixels pixels{numbered ? detection.plane_index : detection.labels,
                           numbered ? std::uint8_t{1} : static_cast<std::uint8_t>(Label::kGround),
                           detection.image_width, detection.image_height};
  return outlineOf(detection.normal, detection.distance, pixels, rays);
}

std::vector<std::vector<Eigen::Vector3d>> furtherOutlines(const Detection& detection,
                                                          const RayTable& rays) {
  std::vector<std::vector<Eigen::Vector3d>> outlines;
  std::uint8_t number = 1;  // the dominant plane's
  for (const FurtherPlane& plane : detection.further_planes) {
    outlines.push_back(outlineOf(
        plane.normal, plane.distance,
        {detection.plane_index, ++number, detection.image_width, detection.image_height}, rays));
  }
  return outlines;
}

}  // namespace dominant_plane_detection
