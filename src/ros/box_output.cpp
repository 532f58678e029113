#include "ros/box_output.h"

#include "navigation/ground_frame.h"
#include "ros/box_messages.h"
#include "ros/listeners.h"
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
  const auto changed = calledByPublishers(listeners_changed);
  boxes_ =
      private_node.advertise<ObstacleBoxArray>(topics::kObstacleBoxes, kQueue, changed, changed);
  markers_ = private_node.advertise<visualization_msgs::MarkerArray>(topics::kBoxMarkers, kQueue,
                                                                     changed, changed);
}

void BoxOutput::publish(const DetectionInputs::Frame& frame, const Detection& detection,
                        const Parameters& detector) {
  if (!anybodyListens()) return;
  Eigen::Isometry3d T_ground_optical = Eigen::Isometry3d::Identity();
  told_.clear();
  if (detection.found()) {
    T_ground_optical = groundFromOptical(detection.normal, detection.distance);
    rays_.build(frame.camera);
    follow(frame.header, T_ground_optical,
           finder_.find(frame.depth, rays_, detection, obstacleLimits(parameters_),
                        detector.local_error));
  }
  const Eigen::Isometry3d T_optical_ground = T_ground_optical.inverse();
  if (boxes_.getNumSubscribers() > 0) {
    boxes_.publish(boxesMessage(frame.header, told_, T_optical_ground));
  }
  if (markers_.getNumSubscribers() > 0) {
    markers_.publish(boxMarkers(frame.header, told_, T_optical_ground));
  }
}

/// Where odometry comes or goes for good, things are other ones: their places are not to be
/// compared.
void BoxOutput::follow(const std_msgs::Header& header, const Eigen::Isometry3d& T_ground_optical,
                       const std::vector<UprightBox>& found) {
  const bool known = place_.has_value();
  const auto place = groundInOdometry(header, T_ground_optical);
  if (place.has_value() != known) tracks_.forget();
  place_ = place;
  told_ =
      tracks_.follow(header.stamp.toSec(), found, place.value_or(Eigen::Isometry2d::Identity()));
}

/// Odometry that comes more slowly than images has none for some of them: the last place will do.
std::optional<Eigen::Isometry2d> BoxOutput::groundInOdometry(
    const std_msgs::Header& header, const Eigen::Isometry3d& T_ground_optical) {
  constexpr double kPatience = 0.25;  // [s]
  if (parameters_.odom_frame.empty()) return std::nullopt;
  const Pose camera = frames_.pose(parameters_.odom_frame, header.frame_id, header.stamp);
  if (camera.transform) {
    placed_ = header.stamp;
    return groundFromAbove(*camera.transform, T_ground_optical);
  }
  const double late = (header.stamp - placed_).toSec();
  return late >= 0.0 && late <= kPatience ? place_ : std::nullopt;
}

}  // namespace dominant_plane_detection
