#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {

/// Turns organised clouds back into the depth image and the pinhole that they came from.
class CloudReader {
 public:
  struct Image {
    DepthView depth;  ///< of the reader's memory, valid until the next call
    CameraModel camera;
  };

  /// @param cloud [m] in an optical frame, with x, y and z as 32-bit floats, as all of PCL's point
  /// types have them; NaN where there is no point.
  /// @param error one sentence with what was expected and what came, if there is no image.
  /// @return nothing for a cloud whose sizes contradict each other, that is not organised, has too
  /// few points to tell the camera, or does not come from a pinhole (points more than half a pixel
  /// off).
  std::optional<Image> read(const sensor_msgs::PointCloud2& cloud, std::string& error);

 private:
  std::vector<float> depth_;
};

/// What a cloud is like.
struct CloudForm {
  int stride = 1;  ///< [px] every n-th point of every n-th row
  /// T_frame_optical; the identity leaves the points in the optical frame.
  Eigen::Isometry3f transform = Eigen::Isometry3f::Identity();
  bool coloured = false;
  const cv::Mat* bgr = nullptr;  ///< 8-bit colours of the image's size; null: all are black
};

/// @return the points of the pixels with a label, those of missing ground on the plane, in PCL's
/// layout of PointXYZ, or of PointXYZRGB if coloured, unorganised and dense. The header is left to
/// the caller.
sensor_msgs::PointCloud2Ptr labelledPoints(const DepthView& depth, const RayTable& rays,
                                           const Detection& detection, Label label,
                                           const CloudForm& form = CloudForm());

}  // namespace dominant_plane_detection
