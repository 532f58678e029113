#include "ros/map_output.h"

#include <ros/console.h>

#include "navigation/ground_frame.h"
#include "navigation/told_height.h"
#include "ros/detection_messages.h"
#include "ros/listeners.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kQueue = 10;
constexpr double kThrottle = 5.0;  // [s] between lines of the same kind
constexpr double kPatience = 1.0;  // [s] for which missing tf is nothing to speak of

MapLimits limitsOf(const NodeParameters& parameters, const Parameters& detector) {
  return {obstacleLimits(parameters), parameters.map_missing_ground, detector.noise,
          freeRange(detector.local_error, parameters.map_obstacle_height)};
}

}  // namespace

MapOutput::MapOutput(ros::NodeHandle& private_node, const NodeParameters& parameters,
                     RobotFrames& frames, RayTable& rays,
                     const std::function<void()>& listeners_changed)
    : parameters_(parameters),
      frames_(frames),
      rays_(rays),
      map_(parameters.map_resolution, parameters.map_size,
           parameters.odom_frame.empty() ? 0.0 : parameters.map_memory) {
  const auto changed = calledByPublishers(listeners_changed);
  publisher_ =
      private_node.advertise<nav_msgs::OccupancyGrid>(topics::kLocalMap, kQueue, changed, changed);
}

/// Of the image's very time: at 1 rad/s a twentieth of a second is three cells at 3 m.
std::optional<Eigen::Isometry3d> MapOutput::cameraInOdometry(const std_msgs::Header& header) {
  const Pose camera = frames_.pose(parameters_.odom_frame, header.frame_id, header.stamp);
  if (camera.transform && camera.exact) {
    lost_.reset();
    return camera.transform;
  }
  if (!lost_ || header.stamp < *lost_) lost_ = header.stamp;
  if ((header.stamp - *lost_).toSec() >= kPatience) {
    ROS_WARN_STREAM_THROTTLE(
        kThrottle, "Nothing is added to the map in "
                       << parameters_.odom_frame << ": "
                       << (camera.problem.empty() ? "tf comes too late" : camera.problem));
  }
  return std::nullopt;
}

bool MapOutput::add(const DetectionInputs::Frame& frame, const Detection& detection,
                    const Parameters& detector) {
  if (!detection.found()) return false;
  Eigen::Isometry2d place = Eigen::Isometry2d::Identity();
  if (keeps()) {
    const auto camera = cameraInOdometry(frame.header);
    if (!camera) return false;
    place = groundFromAbove(*camera, groundFromOptical(detection.normal, detection.distance));
    height_ = (*camera * (-detection.distance * detection.normal)).z();
  }
  rays_.build(frame.camera);
  map_.add(frame.header.stamp.toSec(), frame.depth, rays_, detection,
           limitsOf(parameters_, detector), place);
  return true;
}

/// While nobody listened, or in a bag that begins again, things have changed.
void MapOutput::beginAnewAfterSilence(const ros::Time& stamp) {
  const double seconds = last_ ? (stamp - *last_).toSec() : 0.0;
  last_ = stamp;
  if (seconds >= 0.0 && seconds < parameters_.map_memory) return;
  map_.reset();
  begun_ = false;
}

void MapOutput::publish(const DetectionInputs::Frame& frame, const Detection& detection,
                        const std::optional<std::string>& ground_frame,
                        const Parameters& detector) {
  if (!anybodyListens() || (!keeps() && !ground_frame)) return;
  beginAnewAfterSilence(frame.header.stamp);
  const bool added = add(frame, detection, detector);
  if (!added) map_.age(frame.header.stamp.toSec());
  begun_ = added || (begun_ && keeps());
  if (!begun_) return;
  std_msgs::Header header = frame.header;
  header.frame_id = keeps() ? plainFrame(parameters_.odom_frame) : *ground_frame;
  publisher_.publish(mapMessage(header, map_, height_));
}

}  // namespace dominant_plane_detection
