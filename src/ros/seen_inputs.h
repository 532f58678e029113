#pragma once

#include <ros/time.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <optional>
#include <vector>

#include "doctor/facts.h"

namespace dominant_plane_detection {

/// Keeps what is to be said of depth images and camera_info where something is wrong with them.
class SeenInputs {
 public:
  /// @param rectified whether depth images are.
  explicit SeenInputs(bool rectified) : rectified_(rectified) {}

  void add(const sensor_msgs::Image& image);
  void add(const sensor_msgs::CameraInfo& info);
  void forget() { *this = SeenInputs(rectified_); }

  /// @return of the last image and camera_info.
  const InputFacts& facts() const { return facts_; }
  /// @return see `InputFacts::info_offset`.
  std::optional<double> infoOffset() const;

 private:
  static void keepLatest(std::vector<double>& stamps, const ros::Time& stamp);

  bool rectified_;
  InputFacts facts_;
  std::vector<double> image_stamps_, info_stamps_;  ///< [s] the latest
};

}  // namespace dominant_plane_detection
