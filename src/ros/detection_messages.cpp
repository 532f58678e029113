#include "ros/detection_messages.h"

#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <boost/make_shared.hpp>

namespace dominant_plane_detection {

DominantPlanePtr planeMessage(const std_msgs::Header& header, const Detection& detection,
                              double processing_time) {
  auto message = boost::make_shared<DominantPlane>();
  message->header = header;
  message->state = static_cast<std::uint8_t>(detection.state);
  message->reason = detection.reason;
  message->normal.x = detection.normal.x();
  message->normal.y = detection.normal.y();
  message->normal.z = detection.normal.z();
  message->distance = detection.distance;
  // Symmetric, so Eigen's column-major order is the message's row-major one.
  std::copy_n(detection.covariance.data(), message->covariance.size(), message->covariance.begin());
  message->mean_square_error = detection.mean_square_error;
  message->inliers = static_cast<std::uint32_t>(detection.inliers);
  message->inlier_share = static_cast<float>(detection.inlierShare());
  message->up_source = static_cast<std::uint8_t>(detection.up_source);
  message->tracked = false;
  message->processing_time = static_cast<float>(processing_time);
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
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->encoding = sensor_msgs::image_encodings::MONO8;
  message->width = static_cast<std::uint32_t>(detection.image_width);
  message->height = static_cast<std::uint32_t>(detection.image_height);
  message->step = message->width;
  message->data = detection.labels;
  return message;
}

sensor_msgs::ImagePtr maskMessage(const std_msgs::Header& header, const Detection& detection) {
  sensor_msgs::ImagePtr message = labelsMessage(header, detection);
  constexpr auto kGround = static_cast<std::uint8_t>(Label::kGround);
  for (std::uint8_t& pixel : message->data) pixel = pixel == kGround ? 255 : 0;
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
  const auto colour = [](float r, float g, float b, float a) {
    std_msgs::ColorRGBA rgba;
    rgba.r = r;
    rgba.g = g;
    rgba.b = b;
    rgba.a = a;
    return rgba;
  };
  const auto point = [](const Eigen::Vector3d& r) {
    geometry_msgs::Point p;
    p.x = r.x();
    p.y = r.y();
    p.z = r.z();
    return p;
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
      sheet.points.push_back(point(corner));
    }
  }
  Marker& arrow = add("normal", Marker::ARROW);
  arrow.color = colour(0.1F, 0.6F, 1.0F, 1.0F);
  arrow.scale.x = 0.02;  // [m] of the shaft
  arrow.scale.y = 0.05;  // [m] of the head
  if (!outline.empty()) {
    constexpr double kLength = 0.3;  // [m]
    arrow.points = {point(middle), point(middle + kLength * detection.normal)};
  }
  return message;
}

}  // namespace dominant_plane_detection
