#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "support/recordings.h"
#include "synthetic/triangle_mesh.h"

namespace dominant_plane_detection {

/// Where a set's images show floor, and nothing but: the reference mask closed over single readings
/// that are off. A pixel is floor where 70 % of the 41 x 41 pixels about it are, and its reading is
/// within six sigma(z) of the reference plane, or missing; the image's objects are none.
/// @return 8-bit, 255 = floor.
cv::Mat floorMask(const ReferenceSet& set, const ReferenceImage& image);

/// An image with an object of known size on its floor.
struct StoodIn {
  cv::Mat depth;            ///< as the image's, but for the object's pixels
  std::vector<int> pixels;  ///< row-major indices of the object's readings
};

/// Stands objects into real images: a pixel that one hides gets the object's depth and the error
/// that the real reading had there against the reference plane, scaled by z^2. A missing reading
/// stays missing.
class FloorObjects {
 public:
  /// Keeps references to both.
  FloorObjects(const ReferenceSet& set, const ReferenceImage& image);

  const cv::Mat& floor() const { return floor_; }
  /// @return [m] the reference plane's depth at a pixel; 0 where it is not seen.
  double planeDepth(int u, int v) const;

  /// @param object [m] on z = 0 about the origin; its x axis points away from the camera.
  /// @param u, v [px] where its origin is seen.
  /// @param smear [px] side of the square over which a sensor averages what the object adds; 1: its
  /// edges are sharp.
  /// @return nothing unless all of it is seen, on floor alone, with readings in half of it.
  std::optional<StoodIn> stand(TriangleMesh object, int u, int v, int smear = 1) const;

 private:
  Eigen::Vector3d planePoint(int u, int v) const;

  const ReferenceSet& set_;
  const ReferenceImage& image_;
  Eigen::Isometry3d world_from_camera_;  ///< world: z up, z = 0 is the plane, x away
  cv::Mat floor_;
};

}  // namespace dominant_plane_detection
