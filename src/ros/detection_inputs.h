#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <sensor_msgs/PointCloud2.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "doctor/facts.h"
#include "doctor/finding.h"
#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"
#include "ros/camera_info_matcher.h"
#include "ros/cloud_conversion.h"
#include "ros/depth_conversion.h"
#include "ros/input_watch.h"
#include "ros/seen_inputs.h"

namespace dominant_plane_detection {

/// Where depth comes from.
enum class InputKind : std::uint8_t {
  kDepth,   ///< depth/image_raw and its camera_info
  kPoints,  ///< points, an organised cloud
};

/// Subscribes to the topics that depth comes from, and hands on the newest image that can be looked
/// at. What cannot is dropped with one throttled line that says what was expected and what came.
///
/// All of it happens in the thread of the node's callback queue.
class DetectionInputs {
 public:
  struct Frame {
    std_msgs::Header header;
    DepthView depth;  ///< valid during the call
    CameraModel camera;
  };
  using Callback = std::function<void(const Frame&)>;

  /// What became of the images, since the node started.
  struct Counts {
    std::uint64_t received = 0;
    std::uint64_t overtaken = 0;  ///< a newer one came before they could be looked at
    std::uint64_t refused = 0;    ///< malformed
    /// Why the last one was, the likeliest cause and what to change.
    Finding refusal{Code::kUnusableImages, ""};
  };

  /// @param node topics are relative to it.
  /// @param private_node has `image_transport`.
  /// @param rectified whether depth images are; clouds and their cameras say it themselves.
  DetectionInputs(const ros::NodeHandle& node, const ros::NodeHandle& private_node, InputKind kind,
                  bool rectified, Callback callback);
  ~DetectionInputs();
  DetectionInputs(const DetectionInputs&) = delete;
  DetectionInputs& operator=(const DetectionInputs&) = delete;

  /// @throw image_transport::Exception when `image_transport` names none; nothing is subscribed
  /// then.
  void subscribe();
  void unsubscribe();
  bool subscribed() const { return subscribed_; }

  const Counts& counts() const { return counts_; }
  /// To be called now and then.
  /// @return what is wrong while nothing comes that can be looked at, which the log has as well,
  /// once each time that this begins.
  const std::optional<Finding>& problem();

  /// The topics, resolved, whether they are subscribed or not; empty where none is needed.
  struct Topics {
    std::string depth;  ///< images
    std::string info;   ///< camera_info
    std::string points;
  };
  Topics topics() const;

 private:
  void onImage(const sensor_msgs::ImageConstPtr& image);
  void onInfo(const sensor_msgs::CameraInfoConstPtr& info);
  void onPair(const std::optional<CameraInfoMatcher::Pair>& pair);
  void onPoints(const sensor_msgs::PointCloud2ConstPtr& cloud);
  template <typename Message>
  void keepNewest(std::optional<Message>& newest, const Message& message);
  void handOnNewest();
  void handOn(const CameraInfoMatcher::Pair& pair);
  void handOn(const sensor_msgs::PointCloud2& cloud);
  void refuse(const std::string& what, const std::string& error);
  std::optional<Finding> describe(InputWatch::Problem problem) const;
  InputFacts facts() const;

  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  image_transport::ImageTransport transport_;
  InputKind kind_;
  bool rectified_;
  Callback callback_;

  bool subscribed_ = false;
  bool warned_stamps_ = false;  ///< of camera_info with other stamps
  image_transport::Subscriber images_;
  ros::Subscriber infos_;
  ros::Subscriber points_;

  CameraInfoMatcher matcher_;
  DepthReader depth_reader_;
  CloudReader cloud_reader_;
  /// What comes next: one of the two, and whether `handOnNewest` is on its way.
  std::optional<CameraInfoMatcher::Pair> newest_pair_;
  std::optional<sensor_msgs::PointCloud2ConstPtr> newest_cloud_;
  bool handing_on_ = false;
  Counts counts_;
  InputWatch watch_;
  InputWatch::Problem known_problem_ = InputWatch::Problem::kNone;
  std::optional<Finding> problem_;
  SeenInputs seen_;
};

}  // namespace dominant_plane_detection
