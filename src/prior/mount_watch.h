#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "dominant_plane_detection/prior.h"
#include "prior/known_up.h"
#include "prior/mount_check.h"

namespace dominant_plane_detection {

/// What a camera's place in the robot tells of the ground, z = 0 of the base.
struct MountedGround {
  Up up;                                        ///< in the optical frame
  std::optional<Prior::ExpectedHeight> height;  ///< nothing for a camera that is below it
};

/// @param camera T_base_camera
MountedGround mountedGround(const Eigen::Isometry3d& camera);

/// Holds the planes that are seen against tf: one at the height that tf expects tells whether the
/// mount moved; one that stays at another is told as such.
class MountWatch {
 public:
  /// @param base_frame for the text.
  explicit MountWatch(const std::string& base_frame) : base_frame_(base_frame) {}

  /// @param stamp [s] of the image.
  /// @param camera T_base_camera by tf of the image's very time; only that says something about the
  /// mount.
  /// @param height that tf expects.
  void add(double stamp, const Detection& detection, const std::optional<Eigen::Isometry3d>& camera,
           const std::optional<Prior::ExpectedHeight>& height);
  /// @return how the mount differs from tf, in a sentence; empty where it does not, and after a
  /// second without a plane.
  const std::string& text() const { return text_; }
  /// [#] planes since the last `forget`, by whether they are at the height that tf expects. Where
  /// some are, others are of another level, and say nothing about the mount.
  struct Heights {
    std::size_t expected = 0;
    std::size_t others = 0;
  };
  const Heights& heights() const { return heights_; }
  /// @return whether `text` is of a plane at another height.
  bool isOfHeight() const { return !text_.empty() && elsewhere_ > 0; }
  /// What is usual of the mount stays.
  void forget();
  /// Another camera.
  void reset() { *this = MountWatch(base_frame_); }

 private:
  std::string base_frame_;
  MountCheck check_;
  std::optional<double> compared_;  ///< [s] when a plane was last held against tf
  int elsewhere_ = 0;  ///< [#] images in a row with a plane at another height than tf expects
  Heights heights_;
  std::string text_;
};

}  // namespace dominant_plane_detection
