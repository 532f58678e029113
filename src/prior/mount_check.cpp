#include "prior/mount_check.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.0174533;   // [rad]
constexpr double kWindow = 0.65;        // [s] of images that are averaged
constexpr std::size_t kFewest = 6;      // [#] of them, for which slow cameras may take longer
constexpr double kLongestWindow = 3.0;  // [s]
constexpr double kUsualTime = 20.0;     // [s] that the usual difference is averaged over
constexpr double kUsualFrom = 3.0;      // [s] of images from which on it is known
constexpr double kMostAfter = 150.0;    // [#] images that the numbers are averaged over
constexpr double kRampPatience = 5.0;   // [s]
/// What an uneven floor and a robot that rocks on it explain, as standard deviations; doors' sills
/// and tiles are 5 mm high, wheels half a metre apart.
constexpr double kFloorAngle = 0.5 * kDegree;  // [rad]
constexpr double kFloorHeight = 0.005;         // [m]
/// [-] of chi squared with three degrees of freedom: 99.9 %, and 95 % for either half of the
/// images.
constexpr double kBeyond = 16.27;
constexpr double kHalfBeyond = 7.81;
constexpr double kAgrees = 2.37;  // 50 %
/// A ramp is steeper, and meets the ground as far ahead.
constexpr double kLeastRamp = 2.0 * kDegree;  // [rad]
constexpr double kRampNear = 0.5;             // [m]
constexpr double kRampFar = 5.0;              // [m]

Eigen::Matrix3d unevenFloor() {
  return Eigen::Vector3d(kFloorAngle * kFloorAngle, kFloorAngle * kFloorAngle,
                         kFloorHeight * kFloorHeight)
      .asDiagonal();
}

double chiSquared(const Eigen::Vector3d& difference, const Eigen::Matrix3d& covariance) {
  return difference.dot(covariance.inverse() * difference);
}

/// Rows that turn [normal, distance] in the optical frame into the difference, see `add`.
Eigen::Matrix<double, 3, 4> toDifference(const Eigen::Matrix3d& R_base_camera) {
  Eigen::Matrix<double, 3, 4> rows = Eigen::Matrix<double, 3, 4>::Zero();
  rows.block<1, 3>(0, 0) = R_base_camera.row(1);
  rows.block<1, 3>(1, 0) = -R_base_camera.row(0);
  rows(2, 3) = 1.0;
  return rows;
}

/// @return whether the plane meets tf's ground so far ahead that it may be a ramp.
/// @param camera T_base_camera
bool maybeRamp(const Eigen::Vector3d& difference, const Eigen::Isometry3d& camera) {
  const Eigen::Vector2d ahead = camera.linear().col(2).head<2>();
  if (!(ahead.norm() > 0.1)) return false;
  const Eigen::Vector2d slope(difference.y(), -difference.x());
  const double rise = slope.dot(ahead.normalized());
  // Below the camera's place the plane is as far under tf's ground as the camera is higher.
  const double meets = difference.z() / rise;
  return std::abs(rise) > kLeastRamp && meets > kRampNear && meets < kRampFar;
}

MovedMount movedBy(const Eigen::Vector3d& difference, const Eigen::Isometry3d& camera) {
  MovedMount moved{{difference.x(), difference.y(), difference.z()}, camera};
  const Eigen::Vector3d about(difference.x(), difference.y(), 0.0);
  if (about.norm() > 0.0) {
    moved.camera.linear() =
        Eigen::AngleAxisd(about.norm(), about.normalized()).toRotationMatrix() * camera.linear();
  }
  moved.camera.translation().z() += difference.z();
  return moved;
}

}  // namespace

std::string MovedMount::text() const {
  const Eigen::Vector3d& at = camera.translation();
  const Eigen::Quaterniond turn(camera.linear());
  char text[400];
  std::snprintf(text, sizeof(text),
                "mount moved: by the ground that is seen the camera is turned by %.1f deg (roll) "
                "and %.1f deg (pitch) and %.0f mm higher than tf says; from base to optical frame "
                "it is x y z %.4f %.4f %.4f, quaternion %.5f %.5f %.5f %.5f",
                difference.roll / kDegree, difference.pitch / kDegree, 1e3 * difference.height,
                at.x(), at.y(), at.z(), turn.x(), turn.y(), turn.z(), turn.w());
  return text;
}

MountCheck::Image MountCheck::compare(double stamp, const Detection& detection,
                                      const Eigen::Isometry3d& camera) {
  // The rotation that takes the plane's normal to the base's z axis is the camera's in the base.
  const Eigen::Vector3d normal = camera.linear() * detection.normal;
  const Eigen::AngleAxisd turned(
      Eigen::Quaterniond::FromTwoVectors(normal, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector3d rotation = turned.angle() * turned.axis();
  const Eigen::Matrix<double, 3, 4> rows = toDifference(camera.linear());
  return {stamp,
          {rotation.x(), rotation.y(), detection.distance - camera.translation().z()},
          rows * detection.covariance * rows.transpose()};
}

MountCheck::Mean MountCheck::meanOf(std::size_t begin, std::size_t end) const {
  Mean mean;
  const auto count = static_cast<double>(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    mean.difference += recent_[i].difference / count;
    // Images in a row err alike: their mean is no surer than each of them.
    mean.covariance += recent_[i].covariance / count;
  }
  return mean;
}

/// Where the plane is as tf has it all is well, whatever was usual: tf may have been put right.
bool MountCheck::differs(const Mean& mean, double beyond) const {
  const double from_tf = chiSquared(mean.difference, mean.covariance + unevenFloor());
  const bool agrees = chiSquared(mean.difference, unevenFloor()) < kAgrees;
  const double from_usual = usual_time_ > kUsualFrom && !agrees
                                ? chiSquared(mean.difference - usual_, unevenFloor())
                                : 0.0;
  return std::max(from_tf, from_usual) > beyond;
}

void MountCheck::learn(const Image& image) {
  // After a gap an image counts no more than any other.
  constexpr double kLongest = 0.2;  // [s]
  const double since = recent_.size() > 1 ? recent_[1].stamp - recent_[0].stamp : 0.0;
  const double counts = std::clamp(since, 1e-3, kLongest);
  usual_time_ = std::min(usual_time_ + counts, kUsualTime);
  usual_ += counts / usual_time_ * (image.difference - usual_);
}

/// Both halves: no single image, and no bump. What was told holds until it is clearly over.
bool MountCheck::isOff() const {
  const Mean mean = meanOf(0, recent_.size());
  if (moved_) return differs(mean, kHalfBeyond);
  const std::size_t half = recent_.size() / 2;
  return differs(mean, kBeyond) && differs(meanOf(0, half), kHalfBeyond) &&
         differs(meanOf(half, recent_.size()), kHalfBeyond);
}

/// Means over all images since it is off: the longer, the better.
void MountCheck::follow(const Image& image) {
  if (!since_) {
    since_ = image.stamp;
    const std::size_t half = recent_.size() / 2;  // the first half may be from before
    after_ = meanOf(half, recent_.size()).difference;
    after_images_ = static_cast<double>(recent_.size() - half);
    return;
  }
  after_images_ = std::min(after_images_ + 1.0, kMostAfter);
  after_ += (image.difference - after_) / after_images_;
}

void MountCheck::add(double stamp, const Detection& detection, const Eigen::Isometry3d& camera) {
  if (!recent_.empty() && stamp < recent_.back().stamp) recent_.clear();
  if (!detection.found() || !(detection.covariance(0, 0) >= 0.0)) return;
  const Image image = compare(stamp, detection, camera);
  recent_.push_back(image);
  const auto is_over = [&] {
    const double age = stamp - recent_.front().stamp;
    return age > kLongestWindow || (age > kWindow && recent_.size() > kFewest);
  };
  while (is_over()) {
    if (!since_) learn(recent_.front());
    recent_.pop_front();
  }
  if (recent_.size() < kFewest || stamp - recent_.front().stamp < kWindow / 2.0) return;
  if (!isOff()) {
    since_.reset();
    moved_.reset();
    return;
  }
  follow(image);
  // What was usual is the sensor's, and stays.
  const bool usual = usual_time_ > kUsualFrom;
  const Eigen::Vector3d change = usual ? Eigen::Vector3d(after_ - usual_) : after_;
  if (maybeRamp(change, camera) && stamp - *since_ < kRampPatience) return;
  moved_ = movedBy(change, camera);
}

}  // namespace dominant_plane_detection
