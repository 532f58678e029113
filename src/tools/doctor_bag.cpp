#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <vector>

#include "bag_facts.h"
#include "bag_topics.h"
#include "doctor/input_rules.h"
#include "doctor/robot_rules.h"
#include "doctor/stamp_offset.h"
#include "doctor_report.h"
#include "doctor_sample.h"
#include "image_evidence.h"
#include "mount_evidence.h"
#include "ros/robot_frames.h"

namespace dominant_plane_detection {
namespace {

/// With tf those of the first ten seconds: a mount is judged over seconds, and a ramp is told from
/// it after five.
constexpr double kMountTime = 10.0;        // [s]
constexpr std::size_t kMountImages = 300;  // [#]

class BagExamination {
 public:
  BagExamination(const std::string& file, const DoctorSettings& settings,
                 const RecordingOptions& options)
      : settings_(settings),
        frames_(ros::Duration(1e6)),  // all of the recording is kept
        images_(settings, options.camera),
        mount_(settings.node, frames_) {
    bag_.open(file, rosbag::bagmode::Read);
    facts_ = bagFacts(bag_, settings, options);
    readCameras();
    if (mount_.wanted()) readFrames();
    readImages();
  }

  DoctorReport report(const std::string& file) {
    InputFacts input = facts();
    DoctorReport report{file, summary(), examineInput(input)};
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
  void readCameras() {
    if (facts_.info.name.empty()) return;
    cameras_ = cameraInfos(bag_, facts_.info.name);
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

  void readImages() {
    const TopicFacts& depth = facts_.depth;
    if (depth.name.empty() || depth.type != depth.expected_type) return;
    rosbag::View messages(bag_, rosbag::TopicQuery(depth.name));
    facts_.depth.messages = messages.size();
    const std::size_t every = mount_.wanted() ? 1 : sampleStep(messages.size());
    std::size_t number = 0;
    for (const rosbag::MessageInstance& message : messages) {
      if (number++ % every != 0) continue;
      if (mount_.wanted() && number > kMountImages) break;
      if (!readImage(message)) break;
    }
  }

  /// @return false behind what is looked at of a mount.
  bool readImage(const rosbag::MessageInstance& message) {
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
    if (studied_ == 0) begin_ = header.stamp;
    if (mount_.wanted() && (header.stamp - begin_).toSec() > kMountTime) return false;
    ++studied_;
    stamps_.push_back(header.stamp.toSec());
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
    return info->second;
  }

  InputFacts facts() const {
    InputFacts facts = facts_;
    images_.describe(facts);
    // A recording may begin and end in between.
    if (2 * exact_ < studied_) facts.info_offset = stampOffset(stamps_, infoStamps());
    return facts;
  }

  std::vector<double> infoStamps() const {
    std::vector<double> stamps;
    for (const auto& [stamp, info] : cameras_) stamps.push_back(stamp.toSec());
    return stamps;
  }

  std::string summary() const {
    return std::to_string(studied_) + " of " + std::to_string(facts_.depth.messages) +
           (settings_.points ? " clouds of " : " images of ") + facts_.depth.name + ", " +
           std::to_string(images_.study().planes()) + " with a plane";
  }

  DoctorSettings settings_;
  rosbag::Bag bag_;
  InputFacts facts_;
  std::map<ros::Time, sensor_msgs::CameraInfoConstPtr> cameras_;
  tf2::BufferCore frames_;
  ImageEvidence images_;
  MountEvidence mount_;
  std::vector<double> stamps_;  ///< [s] of images
  ros::Time begin_;             ///< stamp of the first image
  std::size_t studied_ = 0;     ///< [#] images
  std::size_t exact_ = 0;       ///< [#] of them with a camera_info of their stamp
};

}  // namespace

DoctorReport examineBag(const std::string& file, const DoctorSettings& settings,
                        const RecordingOptions& options) {
  return BagExamination(file, settings, options).report(file);
}

}  // namespace dominant_plane_detection
