#pragma once

#include <cstddef>
#include <optional>

#include "doctor/finding.h"
#include "doctor/image_trials.h"
#include "doctor/scale_trials.h"
#include "doctor/shadow_sides.h"

namespace dominant_plane_detection {

/// @return `mirrored` with overwhelming evidence only: many gaps, nearly all on the wrong side.
std::optional<Finding> findMirrored(const ShadowSides& sides);

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

 private:
  DominantPlaneDetector detector_;
  ImageTrials trials_;
  ScaleTrials scales_;
  ShadowSides shadows_;
};

}  // namespace dominant_plane_detection
