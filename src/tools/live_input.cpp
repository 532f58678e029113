#include "live_input.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/median.h"
#include "doctor/finding.h"
#include "doctor/stamp_offset.h"

namespace dominant_plane_detection {

LiveInput::LiveInput(ros::NodeHandle& node, const DoctorSettings& settings,
                     const std::string& depth, const std::string& info,
                     const std::optional<CameraModel>& camera, bool tries)
    : settings_(settings),
      depth_topic_(depth),
      info_topic_(camera ? "" : info),
      images_(settings, camera, tries),
      transport_(node) {
  try {
    subscribe(node);
  } catch (const image_transport::Exception& error) {
    error_ = inOneLine(error.what());
  }
}

void LiveInput::subscribe(ros::NodeHandle& node) {
  constexpr std::uint32_t kQueue = 5;
  if (settings_.points) {
    cloud_subscriber_ = node.subscribe(depth_topic_, kQueue, &LiveInput::onCloud, this);
    return;
  }
  image_subscriber_ = transport_.subscribe(depth_topic_, kQueue, &LiveInput::onImage, this,
                                           image_transport::TransportHints(settings_.transport));
  if (info_topic_.empty()) return;
  info_subscriber_ = node.subscribe(info_topic_, 10 * kQueue, &LiveInput::onInfo, this);
}

void LiveInput::onHeader(const std_msgs::Header& header) {
  stamps_.push_back(header.stamp.toSec());
  const ros::Time now = ros::Time::now();
  if (!now.isZero()) ages_.push_back((now - header.stamp).toSec());
}

void LiveInput::onImage(const sensor_msgs::ImageConstPtr& image) {
  onHeader(image->header);
  newest_ = image;
}

void LiveInput::onCloud(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  onHeader(cloud->header);
  newest_cloud_ = cloud;
}

void LiveInput::onInfo(const sensor_msgs::CameraInfoConstPtr& info) {
  constexpr std::size_t kKept = 30;
  info_stamps_.insert(info->header.stamp.toSec());
  infos_.push_back(info);
  if (infos_.size() > kKept) infos_.pop_front();
}

/// @return the one of the stamp, or else the latest; nothing where none came.
sensor_msgs::CameraInfoConstPtr LiveInput::infoOf(const ros::Time& stamp) const {
  for (const auto& info : infos_) {
    if (info->header.stamp == stamp) return info;
  }
  return infos_.empty() ? nullptr : infos_.back();
}

void LiveInput::look() {
  const auto image = std::exchange(newest_, nullptr);
  const auto cloud = std::exchange(newest_cloud_, nullptr);
  if (image) images_.add(*image, infoOf(image->header.stamp), Prior());
  if (cloud) images_.add(*cloud, Prior());
}

InputFacts LiveInput::facts() const {
  const auto published = publishedTopics();
  InputFacts facts;
  facts.from_points = settings_.points;
  facts.subscription_error = error_;
  facts.depth = topicFacts(published, depth_topic_,
                           settings_.points ? "sensor_msgs/PointCloud2" : "sensor_msgs/Image");
  takeTransport(published, image_subscriber_.getTopic(), facts.depth);
  facts.depth.messages = stamps_.size();
  images_.describe(facts);
  if (!ages_.empty()) facts.age = median(ages_);
  if (!settings_.points && !info_topic_.empty()) describeInfo(published, facts);
  return facts;
}

void LiveInput::describeInfo(const std::optional<ros::master::V_TopicInfo>& published,
                             InputFacts& facts) const {
  facts.info = topicFacts(published, info_topic_, "sensor_msgs/CameraInfo");
  facts.info.messages = info_stamps_.size();
  const auto exact = std::count_if(stamps_.begin(), stamps_.end(),
                                   [this](double stamp) { return info_stamps_.count(stamp) != 0; });
  if (2 * static_cast<std::size_t>(exact) >= stamps_.size()) return;
  facts.info_offset = stampOffset(stamps_, {info_stamps_.begin(), info_stamps_.end()});
}

}  // namespace dominant_plane_detection
