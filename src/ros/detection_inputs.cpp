#include "ros/detection_inputs.h"

#include <cv_bridge/cv_bridge.h>
#include <image_transport/camera_common.h>
#include <pcl_conversions/pcl_conversions.h>
#include <ros/console.h>
#include <ros/master.h>

#include <cmath>

#include "ros/camera_conversion.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr double kThrottle = 5.0;              // [s] between lines of the same kind
constexpr double kSilence = 5.0;               // [s] without input before the one warning
constexpr double kPictureTolerance = 1. / 60;  // [s] half an image's time at 30 Hz
constexpr std::size_t kPictures = 5;

double steadyNow() { return ros::SteadyTime::now().toSec(); }

std::string topicsOfType(const std::string& type) {
  ros::master::V_TopicInfo topics;
  if (!ros::master::getTopics(topics)) return "(the master does not answer)";
  std::string names;
  for (const ros::master::TopicInfo& topic : topics) {
    if (topic.datatype == type) names += (names.empty() ? "" : ", ") + topic.name;
  }
  return names.empty() ? "none" : names;
}

}  // namespace

DetectionInputs::DetectionInputs(const ros::NodeHandle& node, InputKind kind, bool rectified,
                                 Callback callback, PictureCallback picture_callback)
    : node_(node),
      transport_(node),
      kind_(kind),
      rectified_(rectified),
      callback_(std::move(callback)),
      picture_callback_(std::move(picture_callback)) {}

void DetectionInputs::subscribe() {
  subscribed_ = true;
  received_ = false;
  matcher_ = CameraInfoMatcher();
  // Only the newest image is worth looking at; camera_info is small and must not be missed.
  if (kind_ == InputKind::kDepth) {
    constexpr std::uint32_t kInfos = 10;
    images_ = transport_.subscribe(
        topics::kDepth, 1, &DetectionInputs::onImage, this,
        image_transport::TransportHints("raw", ros::TransportHints().tcpNoDelay()));
    infos_ = node_.subscribe(image_transport::getCameraInfoTopic(images_.getTopic()), kInfos,
                             &DetectionInputs::onInfo, this);
  } else {
    points_ = node_.subscribe<pcl::PointCloud<pcl::PointXYZ>>(topics::kPoints, 1,
                                                              &DetectionInputs::onPoints, this);
  }
  pictures_ = transport_.subscribe(topics::kPicture, kPictures, &DetectionInputs::onPicture, this);
  silence_ = node_.createWallTimer(
      ros::WallDuration(kSilence), [this](const ros::WallTimerEvent&) { warnOfSilence(); }, true);
}

void DetectionInputs::unsubscribe() {
  subscribed_ = false;
  silence_.stop();
  images_.shutdown();
  infos_.shutdown();
  points_.shutdown();
  pictures_.shutdown();
  recent_pictures_.clear();
}

void DetectionInputs::onImage(const sensor_msgs::ImageConstPtr& image) {
  received_ = true;
  onPair(matcher_.addImage(image, steadyNow()));
}

void DetectionInputs::onInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  onPair(matcher_.addInfo(info, steadyNow()));
}

void DetectionInputs::onPair(const std::optional<CameraInfoMatcher::Pair>& pair) {
  if (!pair) return;
  if (!pair->exact && !warned_stamps_) {
    warned_stamps_ = true;
    ROS_WARN_STREAM("No " << infos_.getTopic() << " has the stamps of " << images_.getTopic()
                          << "; the latest one of the same frame and size is used.");
  }
  std::string error;
  const auto depth = depth_reader_.read(*pair->image, error);
  const auto camera =
      depth ? cameraModel(*pair->info, rectified_, error) : std::optional<CameraModel>();
  if (camera && (camera->width != depth->width || camera->height != depth->height)) {
    error = "expected a camera_info of the image's size " + std::to_string(depth->width) + " x " +
            std::to_string(depth->height) + ", got " + std::to_string(camera->width) + " x " +
            std::to_string(camera->height);
  }
  if (!error.empty()) {
    ROS_WARN_STREAM_THROTTLE(kThrottle,
                             "Dropped an image of " << images_.getTopic() << ": " << error << ".");
    return;
  }
  // Shows whether images come without a copy: compare with where the driver wrote them.
  ROS_DEBUG_STREAM_NAMED(
      "zero_copy", "depth image of " << pair->image->header.stamp << " is read at " << depth->data);
  callback_({pair->image->header, *depth, *camera});
}

void DetectionInputs::onPoints(
    const boost::shared_ptr<const pcl::PointCloud<pcl::PointXYZ>>& cloud) {
  received_ = true;
  std::string error;
  const auto image = cloud_reader_.read(*cloud, error);
  if (!image) {
    ROS_WARN_STREAM_THROTTLE(kThrottle,
                             "Dropped a cloud of " << points_.getTopic() << ": " << error << ".");
    return;
  }
  callback_({pcl_conversions::fromPCL(cloud->header), image->depth, image->camera});
}

void DetectionInputs::onPicture(const sensor_msgs::ImageConstPtr& picture) {
  recent_pictures_.push_back(picture);
  if (recent_pictures_.size() > kPictures) recent_pictures_.pop_front();
  picture_callback_();
}

std::optional<cv::Mat> DetectionInputs::picture(const std_msgs::Header& header, int width,
                                                int height) const {
  for (auto it = recent_pictures_.rbegin(); it != recent_pictures_.rend(); ++it) {
    const sensor_msgs::Image& picture = **it;
    if (std::abs((picture.header.stamp - header.stamp).toSec()) > kPictureTolerance) continue;
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
  return std::nullopt;
}

void DetectionInputs::warnOfSilence() {
  if (received_) return;
  const bool depth = kind_ == InputKind::kDepth;
  ROS_WARN_STREAM("Nothing came on "
                  << (depth ? images_.getTopic() : points_.getTopic()) << " for " << kSilence
                  << " s. Topics of this type: "
                  << topicsOfType(depth ? "sensor_msgs/Image" : "sensor_msgs/PointCloud2") << ".");
}

}  // namespace dominant_plane_detection
