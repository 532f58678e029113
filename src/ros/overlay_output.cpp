#include "ros/overlay_output.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include "ros/listeners.h"
#include "ros/overlay.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kQueue = 10;

}  // namespace

OverlayOutput::OverlayOutput(const ros::NodeHandle& private_node, PictureInput& pictures,
                             const std::function<void()>& listeners_changed)
    : pictures_(pictures) {
  const auto changed = calledByPublishers(listeners_changed);
  publisher_ = image_transport::ImageTransport(private_node)
                   .advertise(topics::kOverlay, kQueue, changed, changed);
}

void OverlayOutput::publish(const DetectionInputs::Frame& frame, const Detection& detection) {
  if (waiting_) publishWaiting(std::nullopt);  // its picture never came
  if (!anybodyListens()) return;
  waiting_ = Waiting{frame.header, detection, greyPicture(frame.depth)};
  if (!tryPicture() && !pictures_.mayCome()) publishWaiting(std::nullopt);
}

void OverlayOutput::onPicture() {
  if (waiting_) tryPicture();
}

/// @return whether what waits has been published.
bool OverlayOutput::tryPicture() {
  const PictureInput::Found found = pictures_.find(
      waiting_->header, waiting_->detection.image_width, waiting_->detection.image_height);
  if (found.there) publishWaiting(found.bgr);
  return found.there;
}

/// Publishes what waits, over the picture or else over the grey one.
void OverlayOutput::publishWaiting(const std::optional<cv::Mat>& picture) {
  cv::Mat painted = picture ? picture->clone() : waiting_->grey;
  paintOverlay(waiting_->detection, painted);
  publisher_.publish(
      cv_bridge::CvImage(waiting_->header, sensor_msgs::image_encodings::BGR8, painted)
          .toImageMsg());
  waiting_.reset();
}

}  // namespace dominant_plane_detection
