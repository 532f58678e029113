#pragma once

#include <Eigen/Core>
#include <optional>

#include "prior/known_up.h"

namespace dominant_plane_detection {

/// What an inertial sensor shows, in its own frame.
struct InertialReading {
  double stamp;                         ///< [s]
  Eigen::Vector3d acceleration;         ///< [m/s^2] specific force: at rest one g upwards (REP 145)
  std::optional<Eigen::Vector3d> rate;  ///< [rad/s] of a gyroscope
};

/// Which way is up for a sensor that may be moved about.
///
/// Readings are averaged over some tenths of a second, the less those whose size is not that of
/// gravity; where there is a gyroscope, what is averaged turns with it, over seconds. How far the
/// readings lie from their mean says how far that may be off, by motion as well as by turning.
class GravityFilter {
 public:
  /// A reading whose stamp is before the last one's, or a second after it, begins anew.
  void add(const InertialReading& reading);
  /// @param stamp [s]
  /// @return up in the sensor's frame; nothing before there are readings enough, or when the last
  /// one is older than 0.2 s or was taken that much later.
  std::optional<Up> up(double stamp) const;
  void reset() { *this = GravityFilter(); }

 private:
  std::optional<double> stamp_;                     ///< [s] of the last reading
  Eigen::Vector3d mean_ = Eigen::Vector3d::Zero();  ///< [-] weighted mean of unit vectors
  double weight_ = 0.0;                             ///< [s] of readings in the mean
  double square_ = 0.0;                             ///< [rad^2] mean, of readings about it
};

}  // namespace dominant_plane_detection
