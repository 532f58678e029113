#include "ros/cloud_conversion.h"

#include <pcl_conversions/pcl_conversions.h>

#include <Eigen/Cholesky>
#include <boost/make_shared.hpp>
#include <cmath>
#include <limits>

namespace dominant_plane_detection {
namespace {

/// Least-squares line pixel = f * ray + c through many (ray, pixel) pairs.
class Axis {
 public:
  void add(double ray, double pixel) {
    const Eigen::Vector2d row(ray, 1.0);
    normal_.noalias() += row * row.transpose();
    right_ += pixel * row;
    squares_ += pixel * pixel;
    count_ += 1.0;
  }
  /// @return (f, c) [px]
  Eigen::Vector2d solve() const { return normal_.ldlt().solve(right_); }
  /// @return [px] root mean square of what the line leaves.
  double residual(const Eigen::Vector2d& line) const {
    const double sum = squares_ - 2.0 * line.dot(right_) + line.dot(normal_ * line);
    return std::sqrt(std::max(sum, 0.0) / count_);
  }

 private:
  Eigen::Matrix2d normal_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right_ = Eigen::Vector2d::Zero();
  double squares_ = 0.0;
  double count_ = 0.0;
};

}  // namespace

std::optional<CloudReader::Image> CloudReader::read(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                                                    std::string& error) {
  if (cloud.height < 2 || cloud.width < 2 ||
      cloud.size() != static_cast<std::size_t>(cloud.width) * cloud.height) {
    error = "expected an organised cloud, got " + std::to_string(cloud.width) + " x " +
            std::to_string(cloud.height) + " with " + std::to_string(cloud.size()) + " points";
    return std::nullopt;
  }
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  depth_.resize(cloud.size());
  Axis x_axis, y_axis;
  std::size_t points = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const pcl::PointXYZ& p = cloud[i];
    const bool valid = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && p.z > 0.0F;
    depth_[i] = valid ? p.z : kNaN;
    if (!valid) continue;
    ++points;
    x_axis.add(static_cast<double>(p.x / p.z), static_cast<double>(i % cloud.width));
    y_axis.add(static_cast<double>(p.y / p.z), static_cast<double>(i / cloud.width));
  }
  constexpr std::size_t kMinPoints = 100;
  if (points < kMinPoints) {
    error = "expected at least 100 finite points to tell the camera from, got " +
            std::to_string(points);
    return std::nullopt;
  }
  const Eigen::Vector2d x_line = x_axis.solve(), y_line = y_axis.solve();
  const double residual = std::max(x_axis.residual(x_line), y_axis.residual(y_line));
  constexpr double kMaxResidual = 0.5;  // [px]
  Image image;
  image.camera.width = static_cast<int>(cloud.width);
  image.camera.height = static_cast<int>(cloud.height);
  image.camera.fx = x_line[0];
  image.camera.cx = x_line[1];
  image.camera.fy = y_line[0];
  image.camera.cy = y_line[1];
  if (!image.camera.valid() || !(residual < kMaxResidual)) {
    error = "expected the points of a pinhole camera in its optical frame, got points " +
            std::to_string(residual) +
            " pixels off the best one, f = " + std::to_string(x_line[0]) + ", " +
            std::to_string(y_line[0]);
    return std::nullopt;
  }
  image.depth.data = depth_.data();
  image.depth.width = image.camera.width;
  image.depth.height = image.camera.height;
  image.depth.step = cloud.width * sizeof(float);
  image.depth.type = DepthView::Type::kFloat32;
  return image;
}

sensor_msgs::PointCloud2Ptr labelledPoints(const DepthView& depth, const RayTable& rays,
                                           const Detection& detection, Label label) {
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int v = 0; v < detection.image_height; ++v) {
    for (int u = 0; u < detection.image_width; ++u) {
      if (detection.label(u, v) != label) continue;
      const Eigen::Vector3f point = metresAt(depth, u, v) * rays.ray(u, v);
      cloud.push_back({point.x(), point.y(), point.z()});
    }
  }
  auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  pcl::toROSMsg(cloud, *message);
  return message;
}

}  // namespace dominant_plane_detection
