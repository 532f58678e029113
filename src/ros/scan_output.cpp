#include "ros/scan_output.h"

#include <sensor_msgs/LaserScan.h>

#include "ros/detection_messages.h"
#include "ros/listeners.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kQueue = 10;

}  // namespace

ScanOutput::ScanOutput(ros::NodeHandle& private_node, const NodeParameters& parameters,
                       RayTable& rays, const std::function<void()>& listeners_changed)
    : limits_{obstacleLimits(parameters), parameters.scan_missing_ground, 0.0}, rays_(rays) {
  const auto changed = calledByPublishers(listeners_changed);
  publisher_ =
      private_node.advertise<sensor_msgs::LaserScan>(topics::kScan, kQueue, changed, changed);
}

void ScanOutput::publish(const DetectionInputs::Frame& frame, const Detection& detection,
                         const std::optional<std::string>& ground_frame, double range_max) {
  if (!ground_frame || !anybodyListens()) return;
  limits_.range_max = range_max;
  rays_.build(frame.camera);
  std_msgs::Header header = frame.header;
  header.frame_id = *ground_frame;
  publisher_.publish(scanMessage(header, scanner_.scan(frame.depth, rays_, detection, limits_)));
}

}  // namespace dominant_plane_detection
