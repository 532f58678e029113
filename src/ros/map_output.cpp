#include "ros/map_output.h"

#include <ros/console.h>

#include "navigation/ground_frame.h"
#include "navigation/told_height.h"
#include "ros/detection_messages.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kQueue = 10;
constexpr double kThrottle = 5.0;  // [s] between lines of the same kind

}  // namespace

MapOutput::MapOutput(ros::NodeHandle& private_node, const NodeParameters& parameters,
                     RobotFrames& frames, RayTable& rays,
                     const std::function<void()>& listeners_changed)
    : parameters_(parameters),
      frames_(frames),
      rays_(rays),
      map_(parameters.map_resolution, parameters.map_size,
           parameters.odom_frame.empty() ? 0.0 : parameters.map_memory) {
  const ros::SubscriberStatusCallback changed =
      [listeners_changed](const ros::SingleSubscriberPublisher&) { listeners_changed(); };
  publisher_ =
      private_node.advertise<nav_msgs::OccupancyGrid>(topics::kLocalMap, kQueue, changed, changed);
}

std::optional<MapOutput::Place> MapOutput::placeOf(const std_msgs::Header& header,
                                                   const Detection& detection,
                                                   const std::optional<std::string>& ground_frame) {
  if (!detection.found()) return std::nullopt;
  if (parameters_.odom_frame.empty())
    return ground_frame ? std::make_optional(Place()) : std::nullopt;
  const auto camera = frames_.pose(parameters_.odom_frame, header.frame_id, header.stamp);
  if (!camera.transform) {
    ROS_WARN_STREAM_THROTTLE(kThrottle, "Nothing is added to the map in "
                                            << parameters_.odom_frame << ": " << camera.problem);
    return std::nullopt;
  }
  const Eigen::Vector3d foot = *camera.transform * (-detection.distance * detection.normal);
  return Place{
      groundFromAbove(*camera.transform, groundFromOptical(detection.normal, detection.distance)),
      foot.z()};
}

/// While nobody listened, or in a bag that begins again, things have changed.
void MapOutput::beginAnewAfterSilence(const ros::Time& stamp) {
  if (!last_) return;
  const double seconds = (stamp - *last_).toSec();
  if (seconds >= 0.0 && seconds < parameters_.map_memory) return;
  map_.reset();
  last_.reset();
}

void MapOutput::publish(const DetectionInputs::Frame& frame, const Detection& detection,
                        const std::optional<std::string>& ground_frame,
                        const Parameters& detector) {
  if (!anybodyListens()) return;
  beginAnewAfterSilence(frame.header.stamp);
  const double stamp = frame.header.stamp.toSec();
  const auto place = placeOf(frame.header, detection, ground_frame);
  std_msgs::Header header = frame.header;
  header.frame_id = ground_frame.value_or("");
  if (!parameters_.odom_frame.empty()) header.frame_id = parameters_.odom_frame;
  if (place) {
    MapLimits limits;
    static_cast<ObstacleLimits&>(limits) = obstacleLimits(parameters_, detector.range_max);
    limits.missing_ground = parameters_.map_missing_ground;
    limits.noise = detector.noise;
    limits.free_range = freeRange(detector.local_error, parameters_.map_obstacle_height);
    rays_.build(frame.camera);
    map_.add(stamp, frame.depth, rays_, detection, limits, place->pose);
    height_ = place->height;
    last_ = frame.header.stamp;
  } else if (last_ && !parameters_.odom_frame.empty()) {
    map_.age(stamp);
  } else {
    return;
  }
  publisher_.publish(mapMessage(header, map_, height_));
}

}  // namespace dominant_plane_detection
