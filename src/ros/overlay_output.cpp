#include "ros/overlay_output.h"

#include <cv_bridge/cv_bridge.h>
#include <ros/console.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>

#include "ros/overlay.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kQueue = 10;
constexpr std::size_t kPictures = 5;
constexpr double kPictureTolerance = 1. / 60;  // [s] half an image's time at 30 Hz
constexpr double kThrottle = 5.0;              // [s] between lines of the same kind

}  // namespace

OverlayOutput::OverlayOutput(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                             const std::function<void()>& listeners_changed)
    : private_node_(private_node), transport_(node) {
  const auto changed = [listeners_changed](const image_transport::SingleSubscriberPublisher&) {
    listeners_changed();
  };
  publisher_ = image_transport::ImageTransport(private_node)
                   .advertise(topics::kOverlay, kQueue, changed, changed);
}

void OverlayOutput::followListeners() {
  if (!anybodyListens()) {
    endPictures();
    waiting_.reset();
    unregistered_frame_.clear();
  } else if (!pictures_ && unregistered_frame_.empty()) {
    pictures_ = transport_.subscribe(
        topics::kPicture, kPictures, &OverlayOutput::onPicture, this,
        image_transport::TransportHints("raw", ros::TransportHints(), private_node_));
  }
}

void OverlayOutput::endPictures() {
  pictures_.shutdown();
  recent_.clear();
}

void OverlayOutput::publish(const DetectionInputs::Frame& frame, const Detection& detection) {
  if (waiting_) publishWaiting(std::nullopt);  // its picture never came
  if (!anybodyListens()) return;
  if (!unregistered_frame_.empty() && unregistered_frame_ != frame.header.frame_id) {
    unregistered_frame_.clear();
    followListeners();
  }
  waiting_ = Waiting{frame.header, detection, greyPicture(frame.depth)};
  if (tryPicture()) return;
  if (!pictures_ || pictures_.getNumPublishers() == 0) publishWaiting(std::nullopt);
}

void OverlayOutput::onPicture(const sensor_msgs::ImageConstPtr& picture) {
  recent_.push_back(picture);
  if (recent_.size() > kPictures) recent_.pop_front();
  if (!waiting_) return;
  try {
    tryPicture();
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM_THROTTLE(kThrottle, "Dropped an overlay: " << error.what());
  }
}

/// @return whether what waits has been published.
bool OverlayOutput::tryPicture() {
  const sensor_msgs::ImageConstPtr picture = pictureOfWaiting();
  if (!picture) return false;
  const std::string& frame = waiting_->header.frame_id;
  if (picture->header.frame_id == frame) {
    publishWaiting(readPicture(*picture));
    return true;
  }
  ROS_WARN_STREAM("The overlay shows the depth in grey: expected pictures in its frame "
                  << frame << ", as depth registration gives them, got some in "
                  << picture->header.frame_id << " on " << pictures_.getTopic() << ".");
  unregistered_frame_ = frame;
  endPictures();
  publishWaiting(std::nullopt);
  return true;
}

/// @return the picture that is nearest in time to the depth image; null while there is none.
sensor_msgs::ImageConstPtr OverlayOutput::pictureOfWaiting() const {
  const auto apart = [&](const sensor_msgs::ImageConstPtr& picture) {
    return std::abs((picture->header.stamp - waiting_->header.stamp).toSec());
  };
  const auto nearest =
      std::min_element(recent_.begin(), recent_.end(),
                       [&](const auto& a, const auto& b) { return apart(a) < apart(b); });
  return nearest != recent_.end() && apart(*nearest) <= kPictureTolerance ? *nearest : nullptr;
}

/// @return 8-bit BGR of the depth image's size; nothing, and a line in the log, where it is none.
std::optional<cv::Mat> OverlayOutput::readPicture(const sensor_msgs::Image& picture) const {
  const int width = waiting_->detection.image_width, height = waiting_->detection.image_height;
  try {
    cv::Mat bgr = cv_bridge::toCvCopy(picture, sensor_msgs::image_encodings::BGR8)->image;
    if (bgr.cols == width && bgr.rows == height) return bgr;
    ROS_WARN_STREAM_THROTTLE(kThrottle, "The overlay does without "
                                            << pictures_.getTopic() << ": expected " << width
                                            << " x " << height << " pixels, got " << bgr.cols
                                            << " x " << bgr.rows << ".");
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(
        kThrottle, "The overlay does without " << pictures_.getTopic() << ": " << error.what());
  }
  return std::nullopt;
}

/// Publishes what waits, over the picture or else over the grey one.
void OverlayOutput::publishWaiting(const std::optional<cv::Mat>& picture) {
  cv::Mat painted = picture.value_or(waiting_->grey);
  paintOverlay(waiting_->detection, painted);
  publisher_.publish(
      cv_bridge::CvImage(waiting_->header, sensor_msgs::image_encodings::BGR8, painted)
          .toImageMsg());
  waiting_.reset();
}

}  // namespace dominant_plane_detection
