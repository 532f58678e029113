#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// Takes the robot's own body out of depth images.
class BodyMask {
 public:
  using Box = Eigen::AlignedBox3d;  ///< [m] in the robot's base

  explicit BodyMask(std::vector<Box> boxes = {}) : boxes_(std::move(boxes)) {}
  bool empty() const { return boxes_.empty(); }

  /// @param rays of the image's camera.
  /// @param camera T_base_camera
  /// @return the image with readings of a unit, or 1 mm, for those in the boxes, in memory of the
  /// mask that is valid until the next call; the image itself where it shows none of them. Nothing
  /// that near is trusted, and no ground is missing there.
  DepthView mask(const DepthView& depth, const RayTable& rays, const Eigen::Isometry3d& camera);

 private:
  struct Region {
    int left, right, top, bottom;  ///< [px] the last two beyond
  };

  static Region regionOf(const Box& box, const CameraModel& model, const Eigen::Isometry3d& camera);
  void copy(const DepthView& depth);
  void take(const DepthView& depth, int u, int v);

  std::vector<Box> boxes_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace dominant_plane_detection
