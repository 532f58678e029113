#include "ros/box_output.h"

#include "navigation/ground_frame.h"
#include "ros/box_messages.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kQueue = 10;

}  // namespace

BoxOutput::BoxOutput(ros::NodeHandle& private_node, const NodeParameters& parameters,
                     RobotFrames& frames, RayTable& rays,
                     const std::function<void()>& listeners_changed)
    : parameters_(parameters),
      frames_(frames),
      rays_(rays),
      tracks_(static_cast<std::uint32_t>(parameters.box_images)) {
  const ros::SubscriberStatusCallback changed =
      [listeners_changed](const ros::SingleSubscriberPublisher&) { listeners_changed(); };
  boxes_ =
      private_node.advertise<ObstacleBoxArray>(topics::kObstacleBoxes, kQueue, changed, changed);
  markers_ = private_node.advertise<visualization_msgs::MarkerArray>(topics::kBoxMarkers, kQueue,
                                                                     changed, changed);
}

void BoxOutput::publish(const DetectionInputs::Frame& frame, const Detection& detection,
                        const Parameters& detector) {
  if (!anybodyListens()) return;
  Eigen::Isometry3d T_ground_optical = Eigen::Isometry3d::Identity();
  std::vector<TrackedBox> boxes;
  if (detection.found()) {
    T_ground_optical = groundFromOptical(detection.normal, detection.distance);
    rays_.build(frame.camera);
    const auto& found =
        finder_.find(frame.depth, rays_, detection, obstacleLimits(parameters_, detector.range_max),
                     detector.local_error);
    boxes = tracks_.follow(frame.header.stamp.toSec(), found,
                           groundInWorld(frame.header, T_ground_optical));
  }
  if (boxes_.getNumSubscribers() > 0) {
    boxes_.publish(boxesMessage(frame.header, boxes, T_ground_optical.inverse()));
  }
  if (markers_.getNumSubscribers() > 0) {
    markers_.publish(boxMarkers(frame.header, boxes, T_ground_optical.inverse()));
  }
}

/// Where odometry comes or goes, things are other ones: their places are not to be compared.
Eigen::Isometry2d BoxOutput::groundInWorld(const std_msgs::Header& header,
                                           const Eigen::Isometry3d& T_ground_optical) {
  Pose camera;
  if (!parameters_.odom_frame.empty()) {
    camera = frames_.pose(parameters_.odom_frame, header.frame_id, header.stamp);
  }
  if (in_odometry_ != camera.transform.has_value()) tracks_.forget();
  in_odometry_ = camera.transform.has_value();
  return in_odometry_ ? groundFromAbove(*camera.transform, T_ground_optical)
                      : Eigen::Isometry2d::Identity();
}

}  // namespace dominant_plane_detection
