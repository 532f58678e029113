#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>

namespace dominant_plane_detection {

/// How a sensor with a gyroscope turned lately.
class TurnHistory {
 public:
  /// @param stamp [s] @param rate [rad/s] in the sensor's frame, since the reading before.
  void add(double stamp, const Eigen::Vector3d& rate);
  /// @return R_from_to, the sensor's orientation at `to` in its frame at `from`; nothing where the
  /// last second does not reach so far.
  /// @param from, to [s]
  std::optional<Eigen::Quaterniond> turn(double from, double to) const;

 private:
  struct Step {
    double stamp;
    Eigen::Quaterniond orientation;  ///< against the first step's
    Eigen::Vector3d rate;            ///< [rad/s]
  };
  std::optional<Eigen::Quaterniond> at(double stamp) const;

  std::deque<Step> steps_;
};

}  // namespace dominant_plane_detection
