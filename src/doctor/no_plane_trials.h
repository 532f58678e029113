#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "doctor/image_rules.h"

namespace dominant_plane_detection {

/// Looks for the cause while a running detection sees no plane: at an image now and then, from the
/// second second on. With planes it does nothing.
class NoPlaneTrials {
 public:
  /// @return [s] of any steady clock.
  using Clock = std::function<double()>;

  explicit NoPlaneTrials(const Parameters& parameters, Clock clock = steadyNow);

  /// Tries this image where a second has passed since the last one, and twenty times as long as its
  /// trials took: they hold up the detection for a twentieth of the time at the most.
  /// @param detection of the image with this prior.
  void add(const DepthView& depth, const CameraModel& camera, const Prior& prior,
           const Detection& detection);
  /// @return the likeliest cause, if one heals most of the images that were tried, two at least.
  std::optional<Finding> cause() const;

 private:
  static double steadyNow();
  void tryImage(const DepthView& depth, const CameraModel& camera, const Prior& prior,
                const Detection& detection);

  Clock clock_;
  bool is_grid_;           ///< the detection's algorithm is that of the trials
  Parameters parameters_;  ///< of the trials
  ImageTrials trials_;
  ScaleTrials scales_;
  std::size_t rounds_ = 0;      ///< [#] images that were tried
  std::optional<double> last_;  ///< [s] when the last trials ended, or planes did
  double took_ = 0.0;           ///< [s] the last trials
};

}  // namespace dominant_plane_detection
