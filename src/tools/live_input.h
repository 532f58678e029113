#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "doctor/facts.h"
#include "image_evidence.h"
#include "ros/topic_facts.h"

namespace dominant_plane_detection {

/// Listens to the topics of depth, and looks at an image now and then.
class LiveInput {
 public:
  /// @param depth topic of images, or of clouds.
  /// @param info topic of camera_info; empty where none is needed.
  /// @param tries see `ImageStudy`.
  LiveInput(ros::NodeHandle& node, const DoctorSettings& settings, const std::string& depth,
            const std::string& info, const std::optional<CameraModel>& camera, bool tries);

  /// Looks at the newest image, to be called a few times a second.
  void look();
  /// What came until now, with what the master knows.
  InputFacts facts() const;
  const ImageStudy& study() const { return images_.study(); }
  std::size_t messages() const { return stamps_.size(); }

 private:
  void subscribe(ros::NodeHandle& node);
  void describeInfo(const std::optional<ros::master::V_TopicInfo>& published,
                    InputFacts& facts) const;
  void onImage(const sensor_msgs::ImageConstPtr& image);
  void onInfo(const sensor_msgs::CameraInfoConstPtr& info);
  void onCloud(const sensor_msgs::PointCloud2ConstPtr& cloud);
  void onHeader(const std_msgs::Header& header);
  sensor_msgs::CameraInfoConstPtr infoOf(const ros::Time& stamp) const;

  DoctorSettings settings_;
  std::string depth_topic_, info_topic_;
  std::string error_;  ///< why nothing is subscribed
  ImageEvidence images_;
  image_transport::ImageTransport transport_;
  image_transport::Subscriber image_subscriber_;
  ros::Subscriber info_subscriber_, cloud_subscriber_;

  sensor_msgs::ImageConstPtr newest_;
  sensor_msgs::PointCloud2ConstPtr newest_cloud_;
  std::deque<sensor_msgs::CameraInfoConstPtr> infos_;  ///< the latest
  std::vector<double> stamps_;                         ///< [s] of all images
  std::set<double> info_stamps_;                       ///< [s] of all camera_info
  std::vector<double> ages_;                           ///< [s] of images when they came
};

}  // namespace dominant_plane_detection
