#include "prior/gravity_filter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "prior/angle.h"

namespace dominant_plane_detection {
namespace {

constexpr double kGravity = 9.81;       // [m/s^2]
constexpr double kOtherSize = 0.1;      // [-] of gravity: readings off by as much count half
constexpr double kTime = 0.35;          // [s] that readings are averaged over
constexpr double kTimeWithRates = 2.0;  // [s] the same with a gyroscope
constexpr double kLeastWeight = 0.1;    // [s] of readings before there is a mean
constexpr double kGap = 1.0;            // [s] after which all is forgotten
constexpr double kLate = 0.2;           // [s]
constexpr double kLeastError = 0.035;   // [rad] two degrees: an accelerometer's own

double weightOf(double size) {
  const double off = (size / kGravity - 1.0) / kOtherSize;
  return 1.0 / (1.0 + off * off);
}

}  // namespace

void GravityFilter::add(const InertialReading& reading) {
  const double size = reading.acceleration.norm();
  if (!(size > 0.0 && std::isfinite(size))) return;
  if (stamp_ && !(reading.stamp >= *stamp_ && reading.stamp - *stamp_ < kGap)) reset();
  const double since = stamp_ ? reading.stamp - *stamp_ : kLeastWeight / 2.0;
  stamp_ = reading.stamp;
  if (reading.rate && weight_ > 0.0 && reading.rate->allFinite()) {
    // The world turns the other way.
    const double angle = reading.rate->norm() * since;
    if (angle > 0.0) mean_ = Eigen::AngleAxisd(-angle, reading.rate->normalized()) * mean_;
  }
  const double time = reading.rate ? kTimeWithRates : kTime;
  const double weight = since * weightOf(size);
  const double kept = weight_ * std::exp(-since / time);
  weight_ = kept + weight;
  if (!(weight_ > 0.0)) return;
  const Eigen::Vector3d direction = reading.acceleration / size;
  mean_ += weight / weight_ * (direction - mean_);
  const Eigen::Vector3d up = mean_.normalized();
  const double angle = angleBetween(up, direction);
  square_ += weight / weight_ * (angle * angle - square_);
}

std::optional<Up> GravityFilter::up(double stamp) const {
  const bool usable =
      stamp_ && std::abs(stamp - *stamp_) <= kLate && weight_ >= kLeastWeight && mean_.norm() > 0.5;
  if (!usable) return std::nullopt;
  return Up{mean_.normalized(), std::max(std::sqrt(square_), kLeastError)};
}

}  // namespace dominant_plane_detection
