#include "ros/picture_input.h"

#include <cv_bridge/cv_bridge.h>
#include <ros/console.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>

#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr std::size_t kPictures = 5;
constexpr double kThrottle = 5.0;  // [s] between lines of the same kind

}  // namespace

void PictureInput::follow(bool wanted) {
  wanted_ = wanted;
  if (!wanted) {
    end();
    unregistered_frame_.clear();
  } else if (!pictures_ && unregistered_frame_.empty()) {
    pictures_ = transport_.subscribe(
        topics::kPicture, kPictures, &PictureInput::onPicture, this,
        image_transport::TransportHints("raw", ros::TransportHints(), private_node_));
  }
}

void PictureInput::end() {
  pictures_.shutdown();
  recent_.clear();
  read_.reset();
  bgr_.reset();
}

void PictureInput::beginImage(const std::string& frame_id) {
  if (unregistered_frame_.empty() || unregistered_frame_ == frame_id) return;
  unregistered_frame_.clear();
  follow(wanted_);
}

void PictureInput::onPicture(const sensor_msgs::ImageConstPtr& picture) {
  recent_.push_back(picture);
  if (recent_.size() > kPictures) recent_.pop_front();
  try {
    on_picture_();
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM_THROTTLE(kThrottle, "Dropped a picture: " << error.what());
  }
}

/// @return the picture that is nearest in time; null while there is none.
sensor_msgs::ImageConstPtr PictureInput::nearest(const ros::Time& stamp, double tolerance) const {
  const auto apart = [&](const sensor_msgs::ImageConstPtr& picture) {
    return std::abs(picture->header.stamp.toSec() - stamp.toSec());
  };
  const auto found =
      std::min_element(recent_.begin(), recent_.end(),
                       [&](const auto& a, const auto& b) { return apart(a) < apart(b); });
  return found != recent_.end() && apart(*found) <= tolerance ? *found : nullptr;
}

PictureInput::Found PictureInput::find(const std_msgs::Header& header, int width, int height,
                                       double tolerance) {
  const sensor_msgs::ImageConstPtr picture = nearest(header.stamp, tolerance);
  if (!picture) return {};
  if (picture->header.frame_id == header.frame_id) {
    if (picture != read_) bgr_ = read(*picture, width, height);
    read_ = picture;
    return {true, bgr_};
  }
  ROS_WARN_STREAM("Pictures are not used: expected some in the depth's frame "
                  << header.frame_id << ", as depth registration gives them, got some in "
                  << picture->header.frame_id << " on " << pictures_.getTopic() << ".");
  unregistered_frame_ = header.frame_id;
  end();
  return {true, std::nullopt};
}

std::optional<cv::Mat> PictureInput::read(const sensor_msgs::Image& picture, int width,
                                          int height) const {
  try {
    cv::Mat bgr = cv_bridge::toCvCopy(picture, sensor_msgs::image_encodings::BGR8)->image;
    if (bgr.cols == width && bgr.rows == height) return bgr;
    ROS_WARN_STREAM_THROTTLE(kThrottle, "Pictures of " << pictures_.getTopic()
                                                       << " are not used: expected " << width
                                                       << " x " << height << " pixels, got "
                                                       << bgr.cols << " x " << bgr.rows << ".");
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(
        kThrottle, "Pictures of " << pictures_.getTopic() << " are not used: " << error.what());
  }
  return std::nullopt;
}

}  // namespace dominant_plane_detection
