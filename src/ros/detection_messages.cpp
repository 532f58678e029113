#include "ros/detection_messages.h"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <limits>

namespace dominant_plane_detection {
namespace {

/// @return a message that has x, y and z.
template <typename Message>
Message asMessage(const Eigen::Vector3d& vector) {
  Message message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

constexpr float kNearest = 0.01F;  // [m] what is nearer was masked

std_msgs::ColorRGBA colour(float red, float green, float blue, float alpha) {
  std_msgs::ColorRGBA message;
  message.r = red;
  message.g = green;
  message.b = blue;
  message.a = alpha;
  return message;
}

std_msgs::ColorRGBA colourOf(PlaneKind kind) {
  switch (kind) {
    case PlaneKind::kFloor:
      return colour(0.1F, 0.6F, 1.0F, 1.0F);
    case PlaneKind::kRamp:
      return colour(0.2F, 0.9F, 0.3F, 1.0F);
    case PlaneKind::kStep:
      return colour(1.0F, 0.8F, 0.1F, 1.0F);
    case PlaneKind::kTable:
      return colour(1.0F, 0.4F, 0.1F, 1.0F);
    case PlaneKind::kWall:
      return colour(0.8F, 0.8F, 0.8F, 1.0F);
  }
  return colour(1.0F, 1.0F, 1.0F, 1.0F);
}

void setCovariance(const Eigen::Matrix4d& covariance, DominantPlane& message) {
  // Symmetric, so Eigen's column-major order is the message's row-major one.
  std::copy_n(covariance.data(), message.covariance.size(), message.covariance.begin());
}

/// @return mono8, without its pixels.
sensor_msgs::ImagePtr byteImage(const std_msgs::Header& header, const Detection& detection) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->encoding = sensor_msgs::image_encodings::MONO8;
  message->width = static_cast<std::uint32_t>(detection.image_width);
  message->height = static_cast<std::uint32_t>(detection.image_height);
  message->step = message->width;
  return message;
}

}  // namespace

DominantPlanePtr planeMessage(const std_msgs::Header& header, const Detection& detection,
                              double processing_time) {
  auto message = boost::make_shared<DominantPlane>();
  message->header = header;
  message->state = static_cast<std::uint8_t>(detection.state);
  message->reason = detection.reason;
  message->normal = asMessage<geometry_msgs::Vector3>(detection.normal);
  message->distance = detection.distance;
  setCovariance(detection.covariance, *message);
  message->mean_square_error = detection.mean_square_error;
  message->inliers = static_cast<std::uint32_t>(detection.inliers);
  message->inlier_share = static_cast<float>(detection.inlierShare());
  message->up_source = static_cast<std::uint8_t>(detection.up_source);
  message->tracked = detection.tracked;
  message->processing_time = static_cast<float>(processing_time);
  return message;
}

DominantPlaneArrayPtr planesMessage(const std_msgs::Header& header, const Detection& detection,
                                    double processing_time) {
  auto message = boost::make_shared<DominantPlaneArray>();
  message->header = header;
  if (!detection.found()) return message;
  message->planes.push_back(*planeMessage(header, detection, processing_time));
  message->kinds.push_back(DominantPlaneArray::FLOOR);
  for (const FurtherPlane& further : detection.further_planes) {
    DominantPlane plane = message->planes.front();
    plane.normal = asMessage<geometry_msgs::Vector3>(further.normal);
    plane.distance = further.distance;
    setCovariance(further.covariance, plane);
    plane.mean_square_error = further.mean_square_error;
    plane.inliers = static_cast<std::uint32_t>(further.inliers);
    plane.inlier_share = static_cast<float>(static_cast<double>(further.inliers) /
                                            static_cast<double>(detection.valid_pixels));
    message->planes.push_back(plane);
    message->kinds.push_back(static_cast<std::uint8_t>(further.kind));
  }
  return message;
}

pcl_msgs::ModelCoefficientsPtr coefficientsMessage(const std_msgs::Header& header,
                                                   const Detection& detection) {
  auto message = boost::make_shared<pcl_msgs::ModelCoefficients>();
  message->header = header;
  for (int i = 0; i < 3; ++i) message->values.push_back(static_cast<float>(detection.normal[i]));
  message->values.push_back(static_cast<float>(detection.distance));
  return message;
}

sensor_msgs::ImagePtr labelsMessage(const std_msgs::Header& header, const Detection& detection) {
  sensor_msgs::ImagePtr message = byteImage(header, detection);
  message->data = detection.labels;
  return message;
}

sensor_msgs::ImagePtr maskMessage(const std_msgs::Header& header, const Detection& detection) {
  sensor_msgs::ImagePtr message = labelsMessage(header, detection);
  constexpr auto kGround = static_cast<std::uint8_t>(Label::kGround);
  for (std::uint8_t& pixel : message->data) pixel = pixel == kGround ? 255 : 0;
  return message;
}

sensor_msgs::ImagePtr planeIndexMessage(const std_msgs::Header& header,
                                        const Detection& detection) {
  sensor_msgs::ImagePtr message = byteImage(header, detection);
  message->data = detection.plane_index;
  if (!message->data.empty()) return message;
  message->data = detection.labels;
  constexpr auto kGround = static_cast<std::uint8_t>(Label::kGround);
  for (std::uint8_t& pixel : message->data) pixel = pixel == kGround ? 1 : 0;
  return message;
}

sensor_msgs::ImagePtr heightMessage(const std_msgs::Header& header, const DepthView& depth,
                                    const RayTable& rays, const Detection& detection) {
  sensor_msgs::ImagePtr message = byteImage(header, detection);
  message->encoding = sensor_msgs::image_encodings::TYPE_32FC1;
  message->step = message->width * static_cast<std::uint32_t>(sizeof(float));
  message->data.resize(std::size_t{message->step} * message->height);
  const Eigen::Vector3f normal = detection.normal.cast<float>();
  const auto distance = static_cast<float>(detection.distance);
  for (int v = 0; v < detection.image_height; ++v) {
    auto* row = reinterpret_cast<float*>(message->data.data() +
                                         static_cast<std::size_t>(v) * message->step);
    for (int u = 0; u < detection.image_width; ++u) {
      const float z = metresAt(depth, u, v);
      const bool read = z > kNearest && std::isfinite(z);
      row[u] = read ? z * normal.dot(rays.ray(u, v)) + distance
                    : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return message;
}

sensor_msgs::LaserScanPtr scanMessage(const std_msgs::Header& header, const GroundScan& scan) {
  auto message = boost::make_shared<sensor_msgs::LaserScan>();
  message->header = header;
  message->angle_min = static_cast<float>(scan.angle_min);
  message->angle_increment = static_cast<float>(scan.angle_increment);
  message->angle_max = scan.ranges.empty() ? message->angle_min
                                           : static_cast<float>(scan.angle(scan.ranges.size() - 1));
  message->range_min = static_cast<float>(scan.range_min);
  message->range_max = static_cast<float>(scan.range_max);
  message->ranges = scan.ranges;
  return message;
}

nav_msgs::OccupancyGridPtr mapMessage(const std_msgs::Header& header, const LocalMap& map,
                                      double height) {
  auto message = boost::make_shared<nav_msgs::OccupancyGrid>();
  const RollingGrid& grid = map.grid();
  message->header = header;
  message->info.map_load_time = header.stamp;
  message->info.resolution = static_cast<float>(grid.resolution());
  message->info.width = static_cast<std::uint32_t>(grid.cells());
  message->info.height = message->info.width;
  message->info.origin.position.x = grid.origin().x();
  message->info.origin.position.y = grid.origin().y();
  message->info.origin.position.z = height;
  message->info.origin.orientation.w = 1.0;
  message->data.reserve(grid.size());
  for (int y = 0; y < grid.cells(); ++y) {
    for (int x = 0; x < grid.cells(); ++x) message->data.push_back(map.state(x, y));
  }
  return message;
}

pcl_msgs::PointIndicesPtr obstacleIndices(const std_msgs::Header& header,
                                          const Detection& detection) {
  auto message = boost::make_shared<pcl_msgs::PointIndices>();
  message->header = header;
  for (std::size_t i = 0; i < detection.labels.size(); ++i) {
    if (detection.labels[i] == static_cast<std::uint8_t>(Label::kObstacle)) {
      message->indices.push_back(static_cast<std::int32_t>(i));
    }
  }
  return message;
}

geometry_msgs::PolygonStampedPtr outlineMessage(const std_msgs::Header& header,
                                                const std::vector<Eigen::Vector3d>& outline) {
  auto message = boost::make_shared<geometry_msgs::PolygonStamped>();
  message->header = header;
  for (const Eigen::Vector3d& corner : outline) {
    geometry_msgs::Point32 point;
    point.x = static_cast<float>(corner.x());
    point.y = static_cast<float>(corner.y());
    point.z = static_cast<float>(corner.z());
    message->polygon.points.push_back(point);
  }
  return message;
}

visualization_msgs::MarkerArrayPtr markersMessage(const std_msgs::Header& header,
                                                  const Detection& detection,
                                                  const std::vector<Eigen::Vector3d>& outline) {
  using visualization_msgs::Marker;
  auto message = boost::make_shared<visualization_msgs::MarkerArray>();
  const auto add = [&](const char* name, int type) -> Marker& {
    Marker marker;
    marker.header = header;
    marker.ns = name;
    marker.type = type;
    marker.action = outline.empty() ? Marker::DELETE : Marker::ADD;
    marker.pose.orientation.w = 1.0;
    message->markers.push_back(marker);
    return message->markers.back();
  };
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : outline) {
    middle += corner / static_cast<double>(outline.size());
  }

  Marker& sheet = add("plane", Marker::TRIANGLE_LIST);
  sheet.color = colour(0.1F, 0.6F, 1.0F, 0.35F);
  sheet.scale.x = sheet.scale.y = sheet.scale.z = 1.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    for (const Eigen::Vector3d& corner : {middle, outline[i], outline[(i + 1) % outline.size()]}) {
      sheet.points.push_back(asMessage<geometry_msgs::Point>(corner));
    }
  }
  Marker& arrow = add("normal", Marker::ARROW);
  arrow.color = colour(0.1F, 0.6F, 1.0F, 1.0F);
  arrow.scale.x = 0.02;  // [m] of the shaft
  arrow.scale.y = 0.05;  // [m] of the head
  if (!outline.empty()) {
    constexpr double kLength = 0.3;  // [m]
    arrow.points = {asMessage<geometry_msgs::Point>(middle),
                    asMessage<geometry_msgs::Point>(middle + kLength * detection.normal)};
  }
  return message;
}

void addFurtherPlanes(const std_msgs::Header& header, const Detection& detection,
                      const std::vector<std::vector<Eigen::Vector3d>>& outlines,
                      visualization_msgs::MarkerArray& markers) {
  using visualization_msgs::Marker;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (outlines[i].empty()) continue;
    Marker line;
    line.header = header;
    line.ns = "further_planes";
    line.id = static_cast<int>(i);
    line.type = Marker::LINE_STRIP;
    line.pose.orientation.w = 1.0;
    line.lifetime = ros::Duration(0.5);
    line.scale.x = 0.02;  // [m]
    line.color = colourOf(detection.further_planes[i].kind);
    for (const Eigen::Vector3d& corner : outlines[i])
      line.points.push_back(asMessage<geometry_msgs::Point>(corner));
    line.points.push_back(line.points.front());
    markers.markers.push_back(line);
  }
}

}  // namespace dominant_plane_detection
