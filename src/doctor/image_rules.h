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
  /// @param tries whether to look for what heals images; not where somebody else does.
  explicit ImageStudy(const Parameters& parameters, bool tries = true)
      : detector_(parameters), tries_(tries), trials_(parameters), scales_(parameters) {}

  /// @return what the image shows, until the next call.
  const Detection& add(const DepthView& depth, const CameraModel& camera,
                       const Prior& prior = Prior());
  Findings findings() const;

  std::size_t images() const { return images_; }
  std::size_t planes() const { return planes_; }

 private:
  DominantPlaneDetector detector_;
  bool tries_;
  ImageTrials trials_;
  ScaleTrials scales_;
  ShadowSides shadows_;
  std::size_t images_ = 0;
  std::size_t planes_ = 0;  ///< [#] images that show one
};

}  // namespace dominant_plane_detection
