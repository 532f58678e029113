#include "ros/gravity_input.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "prior/angle.h"
#include "ros/topic_names.h"

namespace dominant_plane_detection {
namespace {

constexpr std::uint32_t kQueue = 50;
constexpr double kRawAfter = 0.5;  // [s] without imu/data, for which imu/data_raw is taken
/// [rad] An orientation that is farther from what is felt is no orientation: some drivers leave it
/// as it is made.
constexpr double kAgree = 0.26;
constexpr double kOrientationError = 0.035;  // [rad]

Eigen::Vector3d asVector(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

/// @return up in the sensor's frame by its orientation in a world whose z is up (REP 103); nothing
/// where it says that it has none.
std::optional<Eigen::Vector3d> upByOrientation(const sensor_msgs::Imu& imu) {
  const Eigen::Quaterniond q(imu.orientation.w, imu.orientation.x, imu.orientation.y,
                             imu.orientation.z);
  const bool has_one = imu.orientation_covariance[0] >= 0.0 && std::abs(q.norm() - 1.0) < 0.01;
  if (!has_one) return std::nullopt;
  return q.conjugate() * Eigen::Vector3d::UnitZ();
}

std::optional<Eigen::Vector3d> rateOf(const sensor_msgs::Imu& imu) {
  const Eigen::Vector3d rate = asVector(imu.angular_velocity);
  // What is exactly zero was never measured.
  const bool measured =
      imu.angular_velocity_covariance[0] >= 0.0 && rate.allFinite() && !rate.isZero(0.0);
  return measured ? std::make_optional(rate) : std::nullopt;
}

}  // namespace

void GravityInput::subscribe() {
  data_ = node_.subscribe<sensor_msgs::Imu>(topics::kImuData, kQueue,
                                            [this](const sensor_msgs::ImuConstPtr& imu) {
                                              data_stamp_ = imu->header.stamp.toSec();
                                              onImu(*imu);
                                            });
  raw_ = node_.subscribe<sensor_msgs::Imu>(
      topics::kImu, kQueue, [this](const sensor_msgs::ImuConstPtr& imu) {
        const double behind =
            data_stamp_ ? imu->header.stamp.toSec() - *data_stamp_ : 2.0 * kRawAfter;
        if (std::abs(behind) > kRawAfter) onImu(*imu);
      });
}

void GravityInput::unsubscribe() {
  data_.shutdown();
  raw_.shutdown();
  reset();
}

void GravityInput::reset() {
  data_stamp_.reset();
  frame_.reset();
  filter_.reset();
  turns_ = TurnHistory();
  by_orientation_.reset();
  problem_.clear();
}

void GravityInput::onImu(const sensor_msgs::Imu& imu) {
  if (imu.header.frame_id != frame_) {
    filter_.reset();
    turns_ = TurnHistory();
    frame_ = imu.header.frame_id;
  }
  const double stamp = imu.header.stamp.toSec();
  const auto rate = rateOf(imu);
  if (rate) turns_.add(stamp, *rate);
  if (imu.linear_acceleration_covariance[0] >= 0.0) {
    filter_.add({stamp, asVector(imu.linear_acceleration), rate});
  }
  by_orientation_ = upByOrientation(imu);
}

/// The sensor is fixed to the camera: whatever is known of it last will do.
std::optional<Eigen::Quaterniond> GravityInput::toOptical(const std::string& optical_frame) {
  const Pose pose = frames_.pose(optical_frame, *frame_, ros::Time(0));
  if (!pose.transform) {
    problem_ = pose.problem;
    return std::nullopt;
  }
  return Eigen::Quaterniond(pose.transform->linear());
}

std::optional<Up> GravityInput::up(const std::string& optical_frame, const ros::Time& stamp) {
  problem_.clear();
  if (!frame_) return std::nullopt;
  std::optional<Up> up = filter_.up(stamp.toSec());
  if (!up) {
    problem_ = "Gravity is not known of the image's time: expected steady readings of " + *frame_ +
               " within 0.2 s.";
    return std::nullopt;
  }
  if (by_orientation_) {
    const double apart = angleBetween(*by_orientation_, up->direction);
    if (apart < kAgree + up->error) up = Up{*by_orientation_, std::max(kOrientationError, apart)};
  }
  const auto rotation = toOptical(optical_frame);
  if (!rotation) return std::nullopt;
  return Up{*rotation * up->direction, up->error};
}

std::optional<Eigen::Quaterniond> GravityInput::turn(const std::string& optical_frame, double from,
                                                     double to) {
  const auto turned = turns_.turn(from, to);
  if (!turned) return std::nullopt;
  const auto rotation = toOptical(optical_frame);
  if (!rotation) return std::nullopt;
  return *rotation * *turned * rotation->conjugate();
}

}  // namespace dominant_plane_detection
