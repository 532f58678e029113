#pragma once

#include <memory>

#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/parameters.h"
#include "dominant_plane_detection/prior.h"

namespace dominant_plane_detection {

/// Finds the dominant plane of depth images and labels every pixel by it.
///
/// All memory belongs to the detector and is reused: after the first image of a size, `grid`
/// allocates nothing unless further planes are asked for (`kdtree` builds its trees anew). Not for
/// concurrent use; threads take a detector each.
class DominantPlaneDetector {
 public:
  /// @throw std::invalid_argument that lists every value that cannot be used.
  explicit DominantPlaneDetector(const Parameters& parameters = Parameters());
  ~DominantPlaneDetector();
  DominantPlaneDetector(DominantPlaneDetector&&) noexcept;
  DominantPlaneDetector& operator=(DominantPlaneDetector&&) noexcept;

  /// The result is a function of the arguments and the parameters alone: nothing is carried over
  /// from image to image.
  /// @param depth the image, read in place during the call.
  /// @param camera has to have the size of the image.
  /// @return valid until the next call. Never throws for what an image contains: an image without a
  /// plane, and one that cannot be read (kBadInput), is a result with a reason.
  const Detection& detect(const DepthView& depth, const CameraModel& camera,
                          const Prior& prior = Prior());

  const Parameters& parameters() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace dominant_plane_detection
