#include "ros/detection_outputs.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/image_encodings.h>

#include "ros/detection_messages.h"
#include "ros/overlay.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

/// Results are small against images: a subscriber that is busy for a moment misses none.
constexpr std::uint32_t kQueue = 10;

}  // namespace

void DetectionOutputs::advertise(ros::NodeHandle& node,
                                 const std::function<void()>& listeners_changed) {
  const ros::SubscriberStatusCallback changed =
      [listeners_changed](const ros::SingleSubscriberPublisher&) { listeners_changed(); };
  const image_transport::SubscriberStatusCallback image_changed =
      [listeners_changed](const image_transport::SingleSubscriberPublisher&) {
        listeners_changed();
      };
  plane_ = node.advertise<DominantPlane>(topics::kPlane, kQueue, changed, changed);
  coefficients_ =
      node.advertise<pcl_msgs::ModelCoefficients>(topics::kCoefficients, kQueue, changed, changed);
  obstacles_ =
      node.advertise<sensor_msgs::PointCloud2>(topics::kObstacles, kQueue, changed, changed);
  ground_ = node.advertise<sensor_msgs::PointCloud2>(topics::kGround, kQueue, changed, changed);
  image_transport::ImageTransport transport(node);
  mask_ = transport.advertise(topics::kGroundMask, kQueue, image_changed, image_changed);
  overlay_ = transport.advertise(topics::kOverlay, kQueue, image_changed, image_changed);
}

bool DetectionOutputs::anybodyListens() const {
  return plane_.getNumSubscribers() + coefficients_.getNumSubscribers() +
             obstacles_.getNumSubscribers() + ground_.getNumSubscribers() +
             mask_.getNumSubscribers() + overlay_.getNumSubscribers() >
         0;
}

void DetectionOutputs::publish(const DetectionInputs::Frame& frame, const Detection& detection,
                               double processing_time, const DetectionInputs& inputs) {
  if (plane_.getNumSubscribers() > 0) {
    plane_.publish(planeMessage(frame.header, detection, processing_time));
  }
  if (detection.found() && coefficients_.getNumSubscribers() > 0) {
    coefficients_.publish(coefficientsMessage(frame.header, detection));
  }
  if (mask_.getNumSubscribers() > 0) mask_.publish(maskMessage(frame.header, detection));
  publishClouds(frame, detection);
  if (overlay_.getNumSubscribers() > 0) publishOverlay(frame, detection, inputs);
}

void DetectionOutputs::publishClouds(const DetectionInputs::Frame& frame,
                                     const Detection& detection) {
  const auto publish = [&](const ros::Publisher& publisher, Label label) {
    if (publisher.getNumSubscribers() == 0) return;
    rays_.build(frame.camera);
    const sensor_msgs::PointCloud2Ptr cloud = labelledPoints(frame.depth, rays_, detection, label);
    cloud->header = frame.header;
    publisher.publish(cloud);
  };
  publish(obstacles_, Label::kObstacle);
  publish(ground_, Label::kGround);
}

void DetectionOutputs::publishOverlay(const DetectionInputs::Frame& frame,
                                      const Detection& detection, const DetectionInputs& inputs) {
  cv::Mat picture =
      inputs.picture(frame.header, detection.width, detection.height).value_or(cv::Mat());
  if (picture.empty()) picture = greyPicture(frame.depth);
  paintOverlay(detection, picture);
  overlay_.publish(
      cv_bridge::CvImage(frame.header, sensor_msgs::image_encodings::BGR8, picture).toImageMsg());
}

}  // namespace dominant_plane_detection
