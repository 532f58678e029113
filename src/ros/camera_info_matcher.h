#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <deque>
#include <optional>

namespace dominant_plane_detection {

/// Finds the camera_info of each depth image, whichever of the two comes first.
///
/// Pairs have equal stamps. Where no pair has come for a second, the two are stamped differently
/// for good: then an image takes the latest camera_info of its frame and size.
class CameraInfoMatcher {
 public:
  struct Pair {
    sensor_msgs::ImageConstPtr image;
    sensor_msgs::CameraInfoConstPtr info;
    bool exact;  ///< equal stamps
  };

  /// @param now [s] of any steady clock, the same in all calls.
  /// @return the pair to work on next, if there is one now.
  std::optional<Pair> addImage(const sensor_msgs::ImageConstPtr& image, double now);
  std::optional<Pair> addInfo(const sensor_msgs::CameraInfoConstPtr& info, double now);

 private:
  std::optional<Pair> matched(const Pair& pair, double now);

  std::deque<sensor_msgs::ImageConstPtr> images_;      ///< waiting, oldest first
  std::deque<sensor_msgs::CameraInfoConstPtr> infos_;  ///< recent, oldest first
  std::optional<double> last_match_;                   ///< [s] or when the first image came
};

}  // namespace dominant_plane_detection
