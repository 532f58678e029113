#include "ros/detection_inputs.h"

#include <image_transport/camera_common.h>
#include <ros/callback_queue_interface.h>
#include <ros/console.h>
#include <ros/master.h>

#include <utility>

#include "ros/camera_conversion.h"
#include "ros/queued_call.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr double kThrottle = 5.0;  // [s] between lines of the same kind
/// Messages that wait while one is worked on: only the newest is looked at, the others are counted.
/// Where more come, roscpp drops the oldest, and nobody counts them.
constexpr std::uint32_t kQueue = 5;

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

DetectionInputs::DetectionInputs(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                 InputKind kind, bool rectified, Callback callback)
    : node_(node),
      private_node_(private_node),
      transport_(node),
      kind_(kind),
      rectified_(rectified),
      callback_(std::move(callback)) {}

DetectionInputs::~DetectionInputs() { unsubscribe(); }

void DetectionInputs::subscribe() {
  if (kind_ == InputKind::kDepth) {
    constexpr std::uint32_t kInfos = 10;  // small, and must not be missed
    const image_transport::TransportHints hints("raw", ros::TransportHints().tcpNoDelay(),
                                                private_node_);
    images_ = transport_.subscribe(topics::kDepth, kQueue, &DetectionInputs::onImage, this, hints);
    infos_ = node_.subscribe(image_transport::getCameraInfoTopic(images_.getTopic()), kInfos,
                             &DetectionInputs::onInfo, this);
  } else {
    points_ = node_.subscribe(topics::kPoints, kQueue, &DetectionInputs::onPoints, this);
  }
  subscribed_ = true;
  watch_ = InputWatch(steadyNow());
}

void DetectionInputs::unsubscribe() {
  subscribed_ = false;
  images_.shutdown();
  infos_.shutdown();
  points_.shutdown();
  removeCalls(*node_.getCallbackQueue(), this);
  handing_on_ = false;
  newest_pair_.reset();
  newest_cloud_.reset();
  matcher_ = CameraInfoMatcher();
  known_problem_ = InputWatch::Problem::kNone;
  problem_text_.clear();
}

void DetectionInputs::onImage(const sensor_msgs::ImageConstPtr& image) {
  ++counts_.received;
  watch_.sawImage(steadyNow());
  onPair(matcher_.addImage(image, steadyNow()));
}

void DetectionInputs::onInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  onPair(matcher_.addInfo(info, steadyNow()));
}

void DetectionInputs::onPair(const std::optional<CameraInfoMatcher::Pair>& pair) {
  if (!pair) return;
  watch_.sawMatch();
  if (!pair->exact && !warned_stamps_) {
    warned_stamps_ = true;
    ROS_WARN_STREAM("No " << infos_.getTopic() << " has the stamps of " << images_.getTopic()
                          << "; the latest one of the same frame and size is used.");
  }
  keepNewest(newest_pair_, *pair);
}

void DetectionInputs::onPoints(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  ++counts_.received;
  watch_.sawImage(steadyNow());
  watch_.sawMatch();
  keepNewest(newest_cloud_, cloud);
}

/// The messages that have come meanwhile are in the queue already: they are all here before
/// `handOnNewest` is called.
template <typename Message>
void DetectionInputs::keepNewest(std::optional<Message>& newest, const Message& message) {
  if (newest) ++counts_.overtaken;
  newest = message;
  if (handing_on_) return;
  handing_on_ = true;
  callLater(*node_.getCallbackQueue(), this, [this] { handOnNewest(); });
}

void DetectionInputs::handOnNewest() {
  handing_on_ = false;
  // Taken out before, as the callback may end the subscription.
  const auto pair = std::exchange(newest_pair_, std::nullopt);
  const auto cloud = std::exchange(newest_cloud_, std::nullopt);
  if (pair) handOn(*pair);
  if (cloud) handOn(**cloud);
}

void DetectionInputs::handOn(const CameraInfoMatcher::Pair& pair) {
  std::string error;
  const auto depth = depth_reader_.read(*pair.image, error);
  const auto camera =
      depth ? cameraModel(*pair.info, rectified_, error) : std::optional<CameraModel>();
  if (camera && (camera->width != depth->width || camera->height != depth->height)) {
    error = "expected a camera_info of the image's size " + std::to_string(depth->width) + " x " +
            std::to_string(depth->height) + ", got " + std::to_string(camera->width) + " x " +
            std::to_string(camera->height);
  }
  if (!error.empty()) return refuse("an image of " + images_.getTopic(), error);
  // Shows whether images come without a copy: compare with where the driver wrote them.
  ROS_DEBUG_STREAM_NAMED(
      "zero_copy", "depth image of " << pair.image->header.stamp << " is read at " << depth->data);
  callback_({pair.image->header, *depth, *camera});
}

void DetectionInputs::handOn(const sensor_msgs::PointCloud2& cloud) {
  std::string error;
  const auto image = cloud_reader_.read(cloud, error);
  if (!image) return refuse("a cloud of " + points_.getTopic(), error);
  callback_({cloud.header, image->depth, image->camera});
}

void DetectionInputs::refuse(const std::string& what, const std::string& error) {
  ++counts_.refused;
  counts_.refusal = error;
  ROS_WARN_STREAM_THROTTLE(kThrottle, "Dropped " << what << ": " << error << ".");
}

std::string DetectionInputs::problem() {
  if (!subscribed_) return "";
  const InputWatch::Problem now = watch_.problem(steadyNow());
  const bool begins = now != std::exchange(known_problem_, now);
  if (begins) problem_text_ = describe(now);
  if (begins && now != InputWatch::Problem::kNone) ROS_WARN_STREAM(problem_text_);
  return problem_text_;
}

std::string DetectionInputs::describe(InputWatch::Problem problem) const {
  const bool depth = kind_ == InputKind::kDepth;
  const std::string topic = depth ? images_.getTopic() : points_.getTopic();
  if (problem == InputWatch::Problem::kSilence) {
    const char* const type = depth ? "sensor_msgs/Image" : "sensor_msgs/PointCloud2";
    return "Nothing comes on " + topic + ". Topics of this type: " + topicsOfType(type) + ".";
  }
  if (problem == InputWatch::Problem::kUnmatched) {
    return "Images come on " + topic + ", but no camera_info for them on " + infos_.getTopic() +
           (infos_.getNumPublishers() == 0 ? ", which nobody publishes"
                                           : ": expected the images' frame_id and size") +
           ". Topics of this type: " + topicsOfType("sensor_msgs/CameraInfo") + ".";
  }
  return "";
}

}  // namespace dominant_plane_detection
