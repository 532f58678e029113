#include "ros/box_messages.h"

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cstdio>

namespace dominant_plane_detection {
namespace {

geometry_msgs::Pose poseOf(const UprightBox& box, const Eigen::Isometry3d& T_optical_ground) {
  Eigen::Isometry3d pose = T_optical_ground;
  pose.translate(Eigen::Vector3d(box.centre.x(), box.centre.y(), 0.5 * (box.bottom + box.top)));
  pose.rotate(Eigen::AngleAxisd(box.yaw, Eigen::Vector3d::UnitZ()));
  return tf2::toMsg(pose);
}

visualization_msgs::Marker markerOf(const std_msgs::Header& header, const TrackedBox& tracked) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.id = static_cast<std::int32_t>(tracked.id);
  marker.lifetime = ros::Duration(0.33);
  marker.color.a = 1.0F;
  return marker;
}

/// As large as the thing, and thick enough to be seen.
visualization_msgs::Marker cubeOf(const std_msgs::Header& header, const TrackedBox& tracked,
                                  const Eigen::Isometry3d& T_optical_ground) {
  constexpr double kThinnest = 0.01;  // [m]
  visualization_msgs::Marker cube = markerOf(header, tracked);
  cube.ns = "obstacle_boxes";
  cube.type = visualization_msgs::Marker::CUBE;
  cube.pose = poseOf(tracked.box, T_optical_ground);
  cube.scale.x = std::max(tracked.box.length, kThinnest);
  cube.scale.y = std::max(tracked.box.width, kThinnest);
  cube.scale.z = std::max(tracked.box.top - tracked.box.bottom, kThinnest);
  cube.color.r = 1.0F;
  cube.color.g = 0.45F;
  cube.color.a = 0.45F;
  return cube;
}

visualization_msgs::Marker textOf(const std_msgs::Header& header, const TrackedBox& tracked,
                                  const Eigen::Isometry3d& T_optical_ground) {
  constexpr double kLetters = 0.05, kOver = 0.05;  // [m]
  visualization_msgs::Marker text = markerOf(header, tracked);
  text.ns = "obstacle_box_labels";
  text.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  const Eigen::Vector3d at =
      T_optical_ground *
      Eigen::Vector3d(tracked.box.centre.x(), tracked.box.centre.y(), tracked.box.top + kOver);
  text.pose.position = tf2::toMsg(at);
  text.pose.orientation.w = 1.0;
  text.scale.z = kLetters;
  text.color.r = text.color.g = text.color.b = 1.0F;
  char words[64];
  std::snprintf(words, sizeof(words), "%u: %.1f m, %.2f m high", tracked.id, tracked.box.distance,
                tracked.box.top);
  text.text = words;
  return text;
}

}  // namespace

ObstacleBoxArrayPtr boxesMessage(const std_msgs::Header& header,
                                 const std::vector<TrackedBox>& boxes,
                                 const Eigen::Isometry3d& T_optical_ground) {
  auto message = boost::make_shared<ObstacleBoxArray>();
  message->header = header;
  for (const TrackedBox& tracked : boxes) {
    ObstacleBox box;
    const auto& of = tracked.box;
    box.id = tracked.id;
    box.images = tracked.images;
    box.pose = poseOf(of, T_optical_ground);
    box.size.x = of.length;
    box.size.y = of.width;
    box.size.z = of.top - of.bottom;
    box.distance = static_cast<float>(of.distance);
    box.height = static_cast<float>(of.top);
    box.pixels = static_cast<std::uint32_t>(of.pixels);
    message->boxes.push_back(box);
  }
  return message;
}

visualization_msgs::MarkerArrayPtr boxMarkers(const std_msgs::Header& header,
                                              const std::vector<TrackedBox>& boxes,
                                              const Eigen::Isometry3d& T_optical_ground) {
  auto message = boost::make_shared<visualization_msgs::MarkerArray>();
  for (const TrackedBox& tracked : boxes) {
    message->markers.push_back(cubeOf(header, tracked, T_optical_ground));
    message->markers.push_back(textOf(header, tracked, T_optical_ground));
  }
  return message;
}

}  // namespace dominant_plane_detection
