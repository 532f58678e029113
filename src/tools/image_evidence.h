#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <optional>
#include <string>

#include "doctor/facts.h"
#include "doctor/image_rules.h"
#include "doctor_settings.h"
#include "ros/cloud_conversion.h"
#include "ros/depth_conversion.h"

namespace dominant_plane_detection {

/// Looks at messages as the detection nodelet does, but for the robot's body, which is left in; and
/// keeps what is to be said of them.
class ImageEvidence {
 public:
  /// @param camera holds instead of any camera_info; its size is that of each image where it is 0.
  /// @param tries see `ImageStudy`.
  ImageEvidence(const DoctorSettings& settings, const std::optional<CameraModel>& camera,
                bool tries = true)
      : rectified_(settings.rectified),
        camera_(camera),
        correction_(settings.correction),
        study_(settings.detection, tries) {}

  /// @param info nothing where none came.
  /// @return what the image shows, until the next call; null where it cannot be used.
  const Detection* add(const sensor_msgs::Image& image, const sensor_msgs::CameraInfoConstPtr& info,
                       const Prior& prior);
  const Detection* add(const sensor_msgs::PointCloud2& cloud, const Prior& prior);

  /// Fills in what is known of the images; a refusal where most were refused.
  void describe(InputFacts& facts) const;
  const ImageStudy& study() const { return study_; }

 private:
  const Detection* refuse(const std::string& error);
  const Detection* study(const DepthView& depth, const CameraModel& camera, const Prior& prior);
  std::optional<CameraModel> cameraOf(const sensor_msgs::CameraInfo* info, const DepthView& depth,
                                      std::string& error) const;

  bool rectified_;
  std::optional<CameraModel> camera_;
  std::optional<DepthCorrection> correction_;
  ImageStudy study_;
  DepthReader depth_reader_;
  CloudReader cloud_reader_;
  InputFacts seen_;
  std::string refusal_;  ///< of the last one that was refused
  std::size_t refused_ = 0;
};

}  // namespace dominant_plane_detection
