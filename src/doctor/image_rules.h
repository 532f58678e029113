#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "doctor/depth_spread.h"
#include "doctor/finding.h"
#include "doctor/image_trials.h"
#include "doctor/shadow_sides.h"

namespace dominant_plane_detection {

/// @return `mirrored` with overwhelming evidence only: many gaps, nearly all on the wrong side.
std::optional<Finding> findMirrored(const ShadowSides& sides);

/// Finds readings of a wrong unit: no camera of the kind sees so far or so near, and in one of the
/// common units the same images are plausible and show a plane.
class ScaleTrials {
 public:
  explicit ScaleTrials(const Parameters& parameters) : parameters_(parameters) {}

  void add(const DepthView& depth, const CameraModel& camera, const Prior& prior);
  std::optional<Finding> finding() const;

 private:
  struct Counts {
    std::size_t plausible = 0;  ///< [#] images, with the unit's factor
    std::size_t planes = 0;     ///< [#] of them that show a plane
  };

  Parameters parameters_;
  std::array<Counts, kDepthUnits.size()> counts_{};
  std::size_t images_ = 0;
  std::size_t implausible_ = 0;  ///< [#] as they are
  std::size_t impossible_ = 0;   ///< [#] of these
  DepthSpread spread_;           ///< of the last one
};

/// All that images themselves tell, of a sample of them.
class ImageStudy {
 public:
  explicit ImageStudy(const Parameters& parameters)
      : detector_(parameters), trials_(parameters), scales_(parameters) {}

  /// @return what the image shows, until the next call.
  const Detection& add(const DepthView& depth, const CameraModel& camera,
                       const Prior& prior = Prior());
  Findings findings() const;
  /// The same where somebody else tries what heals images.
  Findings findingsWithoutTrials() const;

  std::size_t images() const { return trials_.images(); }
  std::size_t planes() const { return trials_.planes(); }
  const ShadowSides& shadows() const { return shadows_; }

 private:
  DominantPlaneDetector detector_;
  ImageTrials trials_;
  ScaleTrials scales_;
  ShadowSides shadows_;
};

}  // namespace dominant_plane_detection
