#pragma once

#include <optional>

#include "doctor/image_rules.h"

namespace dominant_plane_detection {

/// Looks for the cause while a running detection sees no plane: at the newest image once a second,
/// from the second second on. With planes it does nothing.
class NoPlaneTrials {
 public:
  explicit NoPlaneTrials(const Parameters& parameters)
      : parameters_(parameters), trials_(parameters), scales_(parameters) {}

  /// @param now [s] of any steady clock.
  /// @param detection of the image with this prior.
  void add(double now, const DepthView& depth, const CameraModel& camera, const Prior& prior,
           const Detection& detection);
  /// @return the likeliest cause, if one heals most of the images that were tried.
  std::optional<Finding> cause() const;

 private:
  Parameters parameters_;
  ImageTrials trials_;
  ScaleTrials scales_;
  std::optional<double> last_;  ///< [s] of the last trial, or when planes ended
};

}  // namespace dominant_plane_detection
