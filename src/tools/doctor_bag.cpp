#include <image_transport/camera_common.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <stdexcept>

#include "bag_topics.h"
#include "doctor/input_rules.h"
#include "doctor/robot_rules.h"
#include "doctor_report.h"
#include "image_evidence.h"
#include "mount_evidence.h"
#include "ros/robot_frames.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kImage = "sensor_msgs/Image";
constexpr const char* kCloud = "sensor_msgs/PointCloud2";
constexpr std::size_t kSample = 60;  // [#] images that are looked at, spread over all
/// With tf those of the first ten seconds: a mount is judged over seconds, and a ramp is told from
/// it after five.
constexpr double kMountTime = 10.0;        // [s]
constexpr std::size_t kMountImages = 300;  // [#]

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

std::string onlyOne(const std::vector<std::string>& topics, const char* what) {
  if (topics.size() == 1) return topics.front();
  throw std::runtime_error("there are several " + std::string(what) +
                           " topics, choose one with --topic: " + listed(topics));
}

class BagExamination {
 public:
  BagExamination(const std::string& file, const DoctorSettings& settings,
                 const RecordingOptions& options)
      : settings_(settings),
        options_(options),
        frames_(ros::Duration(1e6)),  // all of the recording is kept
        images_(settings, options.camera),
        mount_(settings.node, frames_) {
    bag_.open(file, rosbag::bagmode::Read);
    types_ = topicTypes(bag_);
    nameTopics();
    readCameras();
    if (mount_.wanted()) readFrames();
    lookAtImages();
  }

  DoctorReport report(const std::string& file) {
    InputFacts input = facts();
    DoctorReport report{file, lookedAt(), examineInput(input)};
    const auto add = [&](const Findings& more) {
      report.findings.insert(report.findings.end(), more.begin(), more.end());
    };
    add(images_.study().findings());
    for (const Finding& finding : examineRobot(mount_.facts())) {
      if (!hasCode(report.findings, finding.code)) report.findings.push_back(finding);
    }
    return report;
  }

 private:
  void nameTopics() {
    depth_ = facts_.depth.name = options_.topic.empty() ? chooseTopic() : options_.topic;
    facts_.live = false;
    facts_.from_points = settings_.points;
    facts_.depth.expected_type = settings_.points ? kCloud : kImage;
    if (types_.count(depth_) != 0) facts_.depth.type = types_.at(depth_);
    for (const auto& [topic, type] : types_) {
      if (topic == depth_) continue;
      if (facts_.depth.type.empty()) {
        facts_.depth.others.push_back(topic + " (" + type + ")");
      } else if (type == facts_.depth.expected_type) {
        facts_.depth.others.push_back(topic);
      }
      if (type == "sensor_msgs/CameraInfo") facts_.info.others.push_back(topic);
    }
    if (settings_.points || options_.camera || depth_.empty()) return;
    facts_.info.name = image_transport::getCameraInfoTopic(depth_);
    if (types_.count(facts_.info.name) != 0) facts_.info.type = types_.at(facts_.info.name);
  }

  /// @return the topic that can only be meant, even where it is of a wrong type; or none.
  std::string chooseTopic() const {
    std::vector<std::string> clouds, named;
    for (const auto& [topic, type] : types_) {
      if (type == kCloud) clouds.push_back(topic);
      const bool any = type == kImage || type == kCloud;
      if (any && contains(topic, "depth") && contains(topic, "image")) named.push_back(topic);
    }
    const auto depth = depthTopics(bag_);
    const std::vector<std::string> images(depth.begin(), depth.end());
    if (settings_.points && !clouds.empty()) return onlyOne(clouds, "cloud");
    if (!images.empty()) return onlyOne(images, "depth");
    return named.size() == 1 ? named.front() : "";
  }

  void readCameras() {
    if (facts_.info.name.empty()) return;
    rosbag::View infos(bag_, rosbag::TopicQuery(facts_.info.name));
    for (const rosbag::MessageInstance& message : infos) {
      const auto info = message.instantiate<sensor_msgs::CameraInfo>();
      if (info) cameras_[info->header.stamp] = info;
    }
    facts_.info.messages = cameras_.size();
  }

  void readFrames() {
    rosbag::View transforms(bag_,
                            rosbag::TopicQuery(std::vector<std::string>{"/tf", "/tf_static"}));
    for (const rosbag::MessageInstance& message : transforms) {
      const auto tf = message.instantiate<tf2_msgs::TFMessage>();
      if (!tf) continue;
      for (geometry_msgs::TransformStamped transform : tf->transforms) {
        transform.header.frame_id = plainFrame(transform.header.frame_id);
        transform.child_frame_id = plainFrame(transform.child_frame_id);
        frames_.setTransform(transform, "bag", message.getTopic() == "/tf_static");
      }
    }
  }

  void lookAtImages() {
    rosbag::View messages(bag_, rosbag::TopicQuery(depth_));
    if (depth_.empty() || facts_.depth.type != facts_.depth.expected_type) return;
    facts_.depth.messages = messages.size();
    const std::size_t every = mount_.wanted() ? 1 : 1 + messages.size() / kSample;
    std::size_t number = 0;
    for (const rosbag::MessageInstance& message : messages) {
      if (number++ % every != 0) continue;
      if (mount_.wanted() && number > kMountImages) break;
      if (!look(message)) break;
    }
  }

  /// @return false behind what is looked at of a mount.
  bool look(const rosbag::MessageInstance& message) {
    if (settings_.points) {
      const auto cloud = message.instantiate<sensor_msgs::PointCloud2>();
      return add(cloud->header, [&](const Prior& prior) { return images_.add(*cloud, prior); });
    }
    const auto image = message.instantiate<sensor_msgs::Image>();
    const auto info = cameraOf(image->header.stamp);
    return add(image->header, [&](const Prior& prior) { return images_.add(*image, info, prior); });
  }

  template <typename Study>
  bool add(const std_msgs::Header& header, Study&& study) {
    if (looked_ == 0) begin_ = header.stamp;
    if (mount_.wanted() && (header.stamp - begin_).toSec() > kMountTime) return false;
    ++looked_;
    const Detection* const detection = study(mount_.priorOf(header));
    if (detection != nullptr) mount_.add(header, *detection);
    return true;
  }

  /// @return the camera_info of the stamp, or else the nearest.
  sensor_msgs::CameraInfoConstPtr cameraOf(const ros::Time& stamp) {
    if (cameras_.empty()) return nullptr;
    auto info = cameras_.lower_bound(stamp);
    if (info == cameras_.end()) --info;
    if (info->first == stamp) ++exact_;
    if (info != cameras_.begin() && stamp - std::prev(info)->first < info->first - stamp) --info;
    offset_ = (info->first - stamp).toSec();
    return info->second;
  }

  InputFacts facts() const {
    InputFacts facts = facts_;
    images_.describe(facts);
    // A recording may begin and end in between.
    if (!cameras_.empty() && 2 * exact_ < looked_) facts.info_offset = offset_;
    return facts;
  }

  std::string lookedAt() const {
    return std::to_string(looked_) + " of " + std::to_string(facts_.depth.messages) +
           (settings_.points ? " clouds of " : " images of ") + depth_ + ", " +
           std::to_string(images_.study().planes()) + " with a plane";
  }

  DoctorSettings settings_;
  RecordingOptions options_;
  rosbag::Bag bag_;
  std::map<std::string, std::string> types_;  ///< of topics
  std::string depth_;                         ///< topic that is looked at
  InputFacts facts_;
  std::map<ros::Time, sensor_msgs::CameraInfoConstPtr> cameras_;
  tf2::BufferCore frames_;
  ImageEvidence images_;
  MountEvidence mount_;
  ros::Time begin_;         ///< stamp of the first image
  std::size_t looked_ = 0;  ///< [#] images
  std::size_t exact_ = 0;   ///< [#] of them with a camera_info of their stamp
  double offset_ = 0.0;     ///< [s] from the last image to the nearest camera_info
};

}  // namespace

DoctorReport examineBag(const std::string& file, const DoctorSettings& settings,
                        const RecordingOptions& options) {
  return BagExamination(file, settings, options).report(file);
}

}  // namespace dominant_plane_detection
