#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "doctor/depth_spread.h"
#include "doctor/finding.h"
#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/parameters.h"
#include "dominant_plane_detection/prior.h"

namespace dominant_plane_detection {

/// Finds readings of a wrong unit: no camera of the kind sees so far or so near, and in one of the
/// common units the same images are plausible and show a plane. What shows a plane as it is, is of
/// a hall or has something right before the camera, unless no camera at all can have seen it.
class ScaleTrials {
 public:
  explicit ScaleTrials(const Parameters& parameters) : parameters_(parameters) {}

  /// @param detection what was seen of the image as it is.
  void add(const DepthView& depth, const CameraModel& camera, const Prior& prior,
           const Detection& detection);
  /// @return nothing unless it is so in most images; where readings are beyond any doubt a plane is
  /// not asked for.
  std::optional<Finding> finding() const;

 private:
  struct Counts {
    std::size_t plausible = 0;  ///< [#] images, with the unit's factor
    std::size_t planes = 0;     ///< [#] of them that show a plane
  };

  bool explains(std::size_t unit) const;
  double oddness(std::size_t unit) const;
  std::string factors(std::size_t best) const;

  Parameters parameters_;
  std::array<Counts, kDepthUnits.size()> counts_{};
  std::size_t images_ = 0;
  std::size_t implausible_ = 0;  ///< [#] as they are, and without a plane or impossible
  std::size_t impossible_ = 0;   ///< [#] of these
  DepthSpread spread_;           ///< of the last one
};

}  // namespace dominant_plane_detection
