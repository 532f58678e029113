#include "ros/detection_inputs.h"

#include <image_transport/camera_common.h>
#include <ros/callback_queue_interface.h>
#include <ros/console.h>

#include <utility>

#include "doctor/input_rules.h"
#include "ros/camera_conversion.h"
#include "ros/queued_call.h"
#include "ros/topic_facts.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr double kThrottle = 5.0;  // [s] between lines of the same kind
/// Messages that wait while one is worked on: only the newest is looked at, the others are counted.
/// Where more come, roscpp drops the oldest, and nobody counts them.
constexpr std::uint32_t kQueue = 5;

double steadyNow() { return ros::SteadyTime::now().toSec(); }

}  // namespace

DetectionInputs::DetectionInputs(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                 InputKind kind, bool rectified, Callback callback)
    : node_(node),
      private_node_(private_node),
      transport_(node),
      kind_(kind),
      rectified_(rectified),
      callback_(std::move(callback)),
      seen_(rectified) {}

DetectionInputs::~DetectionInputs() { unsubscribe(); }

void DetectionInputs::subscribe() {
  if (kind_ == InputKind::kDepth) {
    constexpr std::uint32_t kInfos = 10;  // small, and must not be missed
    const image_transport::TransportHints hints("raw", ros::TransportHints().tcpNoDelay(),
                                                private_node_);
    images_ = transport_.subscribe(topics::kDepth, kQueue, &DetectionInputs::onImage, this, hints);
    // Not beside images_.getTopic(): that is a topic of the transport, one level below.
    const std::string depth = node_.resolveName(topics::kDepth);
    infos_ = node_.subscribe(image_transport::getCameraInfoTopic(depth), kInfos,
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
  problem_.reset();
  seen_.forget();
}

void DetectionInputs::onImage(const sensor_msgs::ImageConstPtr& image) {
  ++counts_.received;
  watch_.sawImage(steadyNow());
  seen_.add(*image);
  onPair(matcher_.addImage(image, steadyNow()));
}

void DetectionInputs::onInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  seen_.add(*info);
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
  InputFacts refused = facts();
  refused.refusal = error;
  const Findings findings = examineInput(refused);
  counts_.refusal = findings.empty() ? Finding{Code::kUnusableImages, error} : findings.front();
  ROS_WARN_STREAM_THROTTLE(kThrottle, "Dropped " << what << ": " << error << ".");
}

const std::optional<Finding>& DetectionInputs::problem() {
  const InputWatch::Problem now =
      subscribed_ ? watch_.problem(steadyNow()) : InputWatch::Problem::kNone;
  const bool begins = now != std::exchange(known_problem_, now);
  if (begins) problem_ = describe(now);
  if (begins && problem_) ROS_WARN_STREAM(problem_->text);
  return problem_;
}

DetectionInputs::Topics DetectionInputs::topics() const {
  if (kind_ == InputKind::kPoints) return {"", "", node_.resolveName(topics::kPoints)};
  const std::string depth = node_.resolveName(topics::kDepth);
  return {depth, node_.resolveName(image_transport::getCameraInfoTopic(depth)), ""};
}

/// @return what has been seen, without what the master knows.
InputFacts DetectionInputs::facts() const {
  const Topics names = topics();
  InputFacts facts = seen_.facts();
  facts.from_points = kind_ == InputKind::kPoints;
  facts.depth.name = facts.from_points ? names.points : names.depth;
  facts.depth.messages = counts_.received;
  facts.info.name = names.info;
  return facts;
}

std::optional<Finding> DetectionInputs::describe(InputWatch::Problem problem) const {
  if (problem == InputWatch::Problem::kNone) return std::nullopt;
  InputFacts silent = facts();
  const std::size_t infos = silent.info.messages;
  const auto published = publishedTopics();
  silent.depth = topicFacts(published, silent.depth.name,
                            silent.from_points ? "sensor_msgs/PointCloud2" : "sensor_msgs/Image");
  takeTransport(published, images_.getTopic(), silent.depth);
  if (problem == InputWatch::Problem::kUnmatched) {
    silent.depth.messages = 1;
    silent.info = topicFacts(published, silent.info.name, "sensor_msgs/CameraInfo");
    silent.info.messages = infos;
    silent.info_offset = seen_.infoOffset();
  }
  const Findings findings = examineInput(silent);
  return findings.empty() ? std::nullopt : std::optional<Finding>(findings.front());
}

}  // namespace dominant_plane_detection
