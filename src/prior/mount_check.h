#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>
#include <string>

#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {

/// How the ground that is seen lies against the ground of tf, z = 0 of the robot's base.
struct MountDifference {
  double roll = 0.0;    ///< [rad] by which the camera is turned about the base's x axis
  double pitch = 0.0;   ///< [rad] about its y axis, > 0 looks farther down
  double height = 0.0;  ///< [m] by which the camera is higher
};

/// A mount that is not where tf has it. Where it was usual for three seconds that the plane is a
/// little off tf, as the sensor's lasting errors make it, it is off by that no more.
struct MovedMount {
  MountDifference difference;
  Eigen::Isometry3d camera;  ///< T_base_camera as the plane has it; x, y and yaw are those of tf
  /// @return the numbers in one sentence.
  std::string text() const;
};

/// Finds out whether a camera was knocked: whether the plane differs from tf by more than both can
/// explain.
///
/// Over two thirds of a second the mean of the differences is held against what it was before,
/// which has the sensor's lasting errors and a mount that was never measured well in it; and
/// against tf itself, with the planes' covariance. What an uneven floor explains is left out, and a
/// plane that meets tf's ground ahead of the camera has to stay for five seconds: until then it may
/// be a ramp.
class MountCheck {
 public:
  /// @param stamp [s] of the image; after one before the last what is usual stays.
  /// @param detection a plane that is at the height tf expects; others say nothing.
  /// @param camera T_base_camera by tf.
  void add(double stamp, const Detection& detection, const Eigen::Isometry3d& camera);
  /// @return nothing while the mount is where tf has it, or where nothing is known.
  const std::optional<MovedMount>& moved() const { return moved_; }
  void reset() { *this = MountCheck(); }

 private:
  struct Image {
    double stamp;                ///< [s]
    Eigen::Vector3d difference;  ///< see `MountDifference`
    Eigen::Matrix3d covariance;  ///< of it
  };
  /// Of the images of a time.
  struct Mean {
    Eigen::Vector3d difference = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };

  static Image compare(double stamp, const Detection& detection, const Eigen::Isometry3d& camera);
  Mean meanOf(std::size_t begin, std::size_t end) const;
  bool isOff() const;
  void follow(const Image& image);
  /// @param beyond [-] of chi squared.
  bool differs(const Mean& mean, double beyond) const;
  void learn(const Image& image);

  std::deque<Image> recent_;
  Eigen::Vector3d usual_ = Eigen::Vector3d::Zero();  ///< mean before that
  double usual_time_ = 0.0;                          ///< [s] of images in it
  Eigen::Vector3d after_ = Eigen::Vector3d::Zero();  ///< mean since it is off
  double after_images_ = 0.0;                        ///< [#] in it
  std::optional<double> since_;                      ///< [s] when the difference began
  std::optional<MovedMount> moved_;
};

}  // namespace dominant_plane_detection
