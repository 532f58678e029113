#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/parameters.h"

namespace dominant_plane_detection {

/// What is known about the plane of one image before looking; whatever is not given comes from the
/// parameters.
struct Prior {
  struct HeightRange {
    double min;  ///< [m]
    double max;  ///< [m]
  };
  std::optional<Eigen::Vector3d> expected_up;  ///< [-] in the optical frame, of any length
  UpSource up_source = UpSource::kNone;        ///< where expected_up came from
  std::optional<HeightRange> height_range;     ///< [m] camera height over the plane
};

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
