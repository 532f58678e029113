#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {

/// An up direction, and how far it may be off.
struct Up {
  Eigen::Vector3d direction;  ///< [-] unit
  double error;               ///< [rad]
};

/// The same with where it came from.
struct KnownUp {
  Up up;
  UpSource source;
};

/// Chooses the up direction that is trusted most: tf, then gravity; where neither is there nothing
/// is known but the parameters' fixed vector.
///
/// tf that contradicts gravity for a second is passed over: a mount is written wrongly more often
/// than an accelerometer is. A ramp that a robot's flat tf does not know of is no contradiction.
class UpChoice {
 public:
  /// What there is for one image, all in the optical frame.
  struct Candidates {
    std::optional<Up> tf;
    std::optional<Up> gravity;
    std::string tf_problem;       ///< why there is none although it is wanted; empty if it is not
    std::string gravity_problem;  ///< the same
  };

  /// @param stamp [s] of the image.
  std::optional<KnownUp> choose(double stamp, const Candidates& candidates);
  /// @return why something that was wanted is not taken, in one sentence with the numbers; empty
  /// where all is.
  const std::string& remark() const { return remark_; }

 private:
  bool contradicts(double stamp, const Up& tf, const Up& gravity);

  std::optional<double> contradicting_since_;  ///< [s]
  std::string remark_;
};

}  // namespace dominant_plane_detection
