#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"
#include "navigation/obstacle_limits.h"

namespace dominant_plane_detection {

/// The nearest thing in each direction over the ground, as a laser scanner would tell it (REP 117).
struct GroundScan {
  double angle_min = 0.0;        ///< [rad] direction of the first reading; 0 is ahead, > 0 left
  double angle_increment = 0.0;  ///< [rad]
  double range_min = 0.0;        ///< [m]
  double range_max = 0.0;        ///< [m] how far ahead the ground can be seen
  /// [m] from the camera's foot on the plane: NaN where nothing is known, infinite where the ground
  /// was seen, and free, as far as it can be.
  std::vector<float> ranges;

  double angle(std::size_t i) const { return angle_min + static_cast<double>(i) * angle_increment; }
};

struct ScanLimits : ObstacleLimits {
  bool missing_ground = false;  ///< missing ground is an obstacle
  double range_max = 4.0;       ///< [m] farthest depth that was looked at
};

/// Makes scans from labels. Each pixel is a place over the ground, so that pitch and roll of the
/// camera do not matter: its columns are not vertical then.
///
/// Obstacles count from `clearance_height` to `max_obstacle_height` over the plane; a drop-off is
/// where its ray passes through the plane, at its edge. A reading needs 28 pixels, of an image of
/// 640 x 480, within half a degree and 5 cm.
class GroundScanner {
 public:
  /// @param rays of the detection's camera.
  /// @return without a plane no readings; valid until the next call.
  const GroundScan& scan(const DepthView& depth, const RayTable& rays, const Detection& detection,
                         const ScanLimits& limits);

 private:
  struct Cell {
    std::uint32_t points = 0;  ///< [px] weighted
    float sum = 0.0F;          ///< [m] of their ranges
  };

  void begin(const RayTable& rays, const Detection& detection, const ScanLimits& limits);
  void addRow(int v, const DepthView& depth, const RayTable& rays, const Detection& detection,
              const ScanLimits& limits);
  float rangeOf(std::size_t direction, std::uint32_t least) const;
  bool isFree(std::size_t direction) const;

  GroundScan scan_;
  Eigen::Matrix3f rotation_;                  ///< R_ground_optical
  float height_ = 0.0F;                       ///< [m] of the camera
  std::size_t cells_ = 0;                     ///< [#] in a direction
  std::vector<Cell> grid_;                    ///< direction by direction, near to far
  std::vector<float> free_;                   ///< [m] farthest ground in a direction, 0: none
  std::size_t coarse_cells_ = 0;              ///< [#] in a direction, four of the cells each
  std::vector<std::uint16_t> seen_, unseen_;  ///< [#] pixels of ground, and of what is not known
};

}  // namespace dominant_plane_detection
