#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {

/// How a camera is mounted over the floor. Errors are standard errors of the means, how well the
/// result repeats: what the camera gets wrong in every image, such as the scale of depth, is not in
/// them.
struct Mount {
  std::size_t frames = 0;  ///< [#] with a plane
  double height = 0.0;     ///< [m] of the camera that depth is seen from, over the floor
  double pitch = 0.0;      ///< [rad] down, about the axis to the left
  double roll = 0.0;       ///< [rad] to the right, about the axis forward, after the pitch
  double height_error = 0.0;
  double pitch_error = 0.0;
  double roll_error = 0.0;

  double link_offset = 0.0;  ///< [m] from camera_link to the camera, to the right

  /// @return [m] camera_link over the floor.
  double linkHeight() const;
  /// @return the arguments of pioneer.launch, and of a static_transform_publisher.
  std::string launchText() const;
};

/// @param frame_id of the depth images, as camera.launch names it.
/// @return [m] from camera_link to the camera that depth is seen from, to the right: for
/// ..._rgb_optical_frame, which registered depth has, the colour camera, otherwise the depth
/// camera.
double linkOffsetOf(const std::string& frame_id);

/// Averages planes of free floor.
class MountEstimate {
 public:
  /// @param frame_id of the image.
  void add(const Detection& detection, const std::string& frame_id);
  std::size_t frames() const { return seen_; }

  /// @throw std::runtime_error when that is no mount over free floor: too few frames, a plane that
  /// is not there in all of them or does not fill the image, or one that moves.
  Mount mount() const;

 private:
  struct Frame {
    Eigen::Vector3d up;  ///< [-] in the optical frame
    double height;       ///< [m]
  };

  std::vector<Frame> found_;
  std::size_t seen_ = 0;
  double share_ = 0.0;  ///< [-] sum of inlier shares
  std::string frame_id_;
  std::string reason_;  ///< of the last frame without a plane
};

}  // namespace dominant_plane_detection
