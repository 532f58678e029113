#include "ros/detection_outputs.h"

#include <algorithm>

#include "ros/detection_messages.h"
#include "ros/ground_outline.h"
#include "ros/listeners.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

/// Results are small against images: a subscriber that is busy for a moment misses none.
constexpr std::uint32_t kQueue = 10;

}  // namespace

void DetectionOutputs::advertise(ros::NodeHandle& node,
                                 const std::function<void()>& listeners_changed) {
  const auto changed = calledByPublishers(listeners_changed);
  plane_ = node.advertise<DominantPlane>(topics::kPlane, kQueue, changed, changed);
  planes_ = node.advertise<DominantPlaneArray>(topics::kPlanes, kQueue, changed, changed);
  coefficients_ =
      node.advertise<pcl_msgs::ModelCoefficients>(topics::kCoefficients, kQueue, changed, changed);
  obstacle_indices_ =
      node.advertise<pcl_msgs::PointIndices>(topics::kObstacleIndices, kQueue, changed, changed);
  outline_ =
      node.advertise<geometry_msgs::PolygonStamped>(topics::kOutline, kQueue, changed, changed);
  markers_ =
      node.advertise<visualization_msgs::MarkerArray>(topics::kMarkers, kQueue, changed, changed);
  image_transport::ImageTransport transport(node);
  mask_ = transport.advertise(topics::kGroundMask, kQueue, changed, changed);
  labels_ = transport.advertise(topics::kLabels, kQueue, changed, changed);
  plane_index_ = transport.advertise(topics::kPlaneIndex, kQueue, changed, changed);
  height_image_ = transport.advertise(topics::kHeightImage, kQueue, changed, changed);
}

bool DetectionOutputs::anybodyListens() const {
  const auto listened = [](const auto& publisher) { return publisher.getNumSubscribers() > 0; };
  const auto messages = {&plane_,   &planes_, &coefficients_, &obstacle_indices_,
                         &outline_, &markers_};
  const auto images = {&mask_, &labels_, &plane_index_, &height_image_};
  const auto any = [&](const auto& publishers) {
    return std::any_of(publishers.begin(), publishers.end(),
                       [&](const auto* publisher) { return listened(*publisher); });
  };
  return any(messages) || any(images);
}

void DetectionOutputs::publish(const DetectionInputs::Frame& frame, const Detection& detection,
                               double processing_time) {
  if (plane_.getNumSubscribers() > 0) {
    plane_.publish(planeMessage(frame.header, detection, processing_time));
  }
  if (planes_.getNumSubscribers() > 0) {
    planes_.publish(planesMessage(frame.header, detection, processing_time));
  }
  if (detection.found() && coefficients_.getNumSubscribers() > 0) {
    coefficients_.publish(coefficientsMessage(frame.header, detection));
  }
  if (obstacle_indices_.getNumSubscribers() > 0) {
    obstacle_indices_.publish(obstacleIndices(frame.header, detection));
  }
  publishImages(frame, detection);
  publishShapes(frame, detection);
}

void DetectionOutputs::publishImages(const DetectionInputs::Frame& frame,
                                     const Detection& detection) {
  if (mask_.getNumSubscribers() > 0) mask_.publish(maskMessage(frame.header, detection));
  if (labels_.getNumSubscribers() > 0) labels_.publish(labelsMessage(frame.header, detection));
  if (plane_index_.getNumSubscribers() > 0) {
    plane_index_.publish(planeIndexMessage(frame.header, detection));
  }
  if (height_image_.getNumSubscribers() > 0) {
    rays_.build(frame.camera);
    height_image_.publish(heightMessage(frame.header, frame.depth, rays_, detection));
  }
}

void DetectionOutputs::publishShapes(const DetectionInputs::Frame& frame,
                                     const Detection& detection) {
  if (outline_.getNumSubscribers() + markers_.getNumSubscribers() == 0) return;
  rays_.build(frame.camera);
  const std::vector<Eigen::Vector3d> outline = groundOutline(detection, rays_);
  if (!outline.empty()) outline_.publish(outlineMessage(frame.header, outline));
  if (markers_.getNumSubscribers() == 0) return;
  const visualization_msgs::MarkerArrayPtr markers =
      markersMessage(frame.header, detection, outline);
  addFurtherPlanes(frame.header, detection, furtherOutlines(detection, rays_), *markers);
  markers_.publish(markers);
}

}  // namespace dominant_plane_detection
