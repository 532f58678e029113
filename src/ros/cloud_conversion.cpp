#include "ros/cloud_conversion.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl_conversions/pcl_conversions.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <boost/make_shared.hpp>
#include <cmath>
#include <cstring>
#include <limits>

#include "ros/byte_order.h"

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

/// Where a point's x, y and z are, in bytes from its first one.
using Offsets = std::array<std::size_t, 3>;

/// @return nothing where one of the three is missing, is no single float, or reaches beyond the
/// point.
std::optional<Offsets> findCoordinates(const sensor_msgs::PointCloud2& cloud) {
  constexpr const char* kNames[] = {"x", "y", "z"};
  Offsets offsets{};
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const auto field = std::find_if(cloud.fields.begin(), cloud.fields.end(),
                                    [&](const auto& f) { return f.name == kNames[i]; });
    const bool usable = field != cloud.fields.end() &&
                        field->datatype == sensor_msgs::PointField::FLOAT32 &&
                        std::size_t{field->offset} + sizeof(float) <= cloud.point_step;
    if (!usable) return std::nullopt;
    offsets[i] = field->offset;
  }
  return offsets;
}

/// Nothing of a message is trusted before its sizes are known to agree.
/// @return what is wrong with them; empty when nothing is.
std::string findContradiction(const sensor_msgs::PointCloud2& cloud) {
  const auto text = [](auto value) { return std::to_string(value); };
  constexpr std::uint32_t kMaxSide = 1U << 15U;  // keeps every index an int
  if (cloud.height < 2 || cloud.width < 2 || cloud.height > kMaxSide || cloud.width > kMaxSide) {
    return "expected an organised cloud of 2 to 32768 points each way, got " + text(cloud.width) +
           " x " + text(cloud.height);
  }
  const std::size_t row = std::size_t{cloud.width} * cloud.point_step;
  if (cloud.row_step < row) {
    return "expected a row_step of at least " + text(row) + " bytes for " + text(cloud.width) +
           " points of " + text(cloud.point_step) + ", got " + text(cloud.row_step);
  }
  const std::size_t all = std::size_t{cloud.row_step} * (cloud.height - 1) + row;
  if (cloud.data.size() < all) {
    return "expected at least " + text(all) + " bytes of points, got " + text(cloud.data.size());
  }
  if (!findCoordinates(cloud)) return "expected the fields x, y and z, one 32-bit float each";
  if ((cloud.is_bigendian != 0) != machineIsBigEndian()) {
    return "expected points in this machine's byte order";
  }
  return "";
}

}  // namespace

std::optional<CloudReader::Image> CloudReader::read(const sensor_msgs::PointCloud2& cloud,
                                                    std::string& error) {
  error = findContradiction(cloud);
  if (!error.empty()) return std::nullopt;
  const Offsets offsets = *findCoordinates(cloud);
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  depth_.resize(std::size_t{cloud.width} * cloud.height);
  Axis x_axis, y_axis;
  std::size_t points = 0;
  for (std::uint32_t v = 0; v < cloud.height; ++v) {
    const std::uint8_t* point = cloud.data.data() + std::size_t{v} * cloud.row_step;
    for (std::uint32_t u = 0; u < cloud.width; ++u, point += cloud.point_step) {
      float x = 0.0F, y = 0.0F, z = 0.0F;
      std::memcpy(&x, point + offsets[0], sizeof(x));
      std::memcpy(&y, point + offsets[1], sizeof(y));
      std::memcpy(&z, point + offsets[2], sizeof(z));
      const bool valid = std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && z > 0.0F;
      depth_[std::size_t{v} * cloud.width + u] = valid ? z : kNaN;
      if (!valid) continue;
      ++points;
      x_axis.add(static_cast<double>(x / z), static_cast<double>(u));
      y_axis.add(static_cast<double>(y / z), static_cast<double>(v));
    }
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

namespace {

void setColour(pcl::PointXYZ&, const cv::Mat*, int, int) {}
void setColour(pcl::PointXYZRGB& point, const cv::Mat* bgr, int u, int v) {
  const cv::Vec3b colour = bgr == nullptr ? cv::Vec3b() : bgr->at<cv::Vec3b>(v, u);
  point.b = colour[0];
  point.g = colour[1];
  point.r = colour[2];
}

template <typename Point>
sensor_msgs::PointCloud2Ptr pointsOf(const DepthView& depth, const RayTable& rays,
                                     const Detection& detection, Label label,
                                     const CloudForm& form) {
  const Eigen::Vector3f normal = detection.normal.cast<float>();
  const auto distance = static_cast<float>(detection.distance);
  pcl::PointCloud<Point> cloud;
  for (int v = 0; v < detection.image_height; v += form.stride) {
    for (int u = 0; u < detection.image_width; u += form.stride) {
      if (detection.label(u, v) != label) continue;
      const Eigen::Vector3f ray = rays.ray(u, v);
      // What was not read is where the plane is.
      const float z =
          label == Label::kMissingGround ? -distance / normal.dot(ray) : metresAt(depth, u, v);
      Point point;
      point.getVector3fMap() = form.transform * Eigen::Vector3f(z * ray);
      setColour(point, form.bgr, u, v);
      cloud.push_back(point);
    }
  }
  auto message = boost::make_shared<sensor_msgs::PointCloud2>();
  pcl::toROSMsg(cloud, *message);
  return message;
}

}  // namespace

sensor_msgs::PointCloud2Ptr labelledPoints(const DepthView& depth, const RayTable& rays,
                                           const Detection& detection, Label label,
                                           const CloudForm& form) {
  return form.coloured ? pointsOf<pcl::PointXYZRGB>(depth, rays, detection, label, form)
                       : pointsOf<pcl::PointXYZ>(depth, rays, detection, label, form);
}

}  // namespace dominant_plane_detection
