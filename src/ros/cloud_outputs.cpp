#include "ros/cloud_outputs.h"

#include <ros/console.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>

#include "ros/cloud_conversion.h"
#include "ros/listeners.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kQueue = 10;
constexpr double kThrottle = 5.0;  // [s] between lines of the same kind

}  // namespace

CloudOutputs::CloudOutputs(ros::NodeHandle& private_node, const NodeParameters& parameters,
                           RobotFrames& frames, PictureInput& pictures, RayTable& rays,
                           const std::function<void()>& listeners_changed)
    : parameters_(parameters), frames_(frames), pictures_(pictures), rays_(rays) {
  const auto changed = calledByPublishers(listeners_changed);
  for (LabelledCloud& cloud : clouds_) {
    cloud.publisher =
        private_node.advertise<sensor_msgs::PointCloud2>(cloud.topic, kQueue, changed, changed);
  }
}

bool CloudOutputs::anybodyListens() const {
  return std::any_of(clouds_.begin(), clouds_.end(), [](const LabelledCloud& cloud) {
    return cloud.publisher.getNumSubscribers() > 0;
  });
}

void CloudOutputs::publish(const DetectionInputs::Frame& frame, const Detection& detection) {
  if (!anybodyListens()) return;
  CloudForm form;
  form.stride = parameters_.stride;
  std_msgs::Header header = frame.header;
  if (parameters_.clouds_in_base_frame) {
    const auto pose = frames_.pose(parameters_.base_frame, header.frame_id, header.stamp);
    if (!pose.transform) {
      ROS_WARN_STREAM_THROTTLE(kThrottle,
                               "No clouds in " << parameters_.base_frame << ": " << pose.problem);
      return;
    }
    form.transform = pose.transform->cast<float>();
    header.frame_id = parameters_.base_frame;
  }
  std::optional<cv::Mat> picture;
  form.coloured = parameters_.coloured_clouds;
  if (form.coloured) {
    // That of the image before will do: clouds do not wait.
    constexpr double kTolerance = 0.1;  // [s]
    picture =
        pictures_.find(frame.header, detection.image_width, detection.image_height, kTolerance).bgr;
    if (picture) form.bgr = &*picture;
  }
  rays_.build(frame.camera);
  for (const LabelledCloud& cloud : clouds_) {
    if (cloud.publisher.getNumSubscribers() == 0) continue;
    const sensor_msgs::PointCloud2Ptr points =
        labelledPoints(frame.depth, rays_, detection, cloud.label, form);
    points->header = header;
    cloud.publisher.publish(points);
  }
}

}  // namespace dominant_plane_detection
