#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "navigation/connected_obstacles.h"

namespace dominant_plane_detection {

/// Something that stands on the ground, or hangs over it, as far as it is seen: an upright box.
struct UprightBox {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< [m] on the ground
  double yaw = 0.0;                                  ///< [rad] of its length against x
  double length = 0.0, width = 0.0;                  ///< [m] on the ground, length >= width
  double bottom = 0.0, top = 0.0;                    ///< [m] over the ground
  double distance = 0.0;   ///< [m] over the ground, from below the camera to what is nearest
  std::size_t pixels = 0;  ///< [px]
};

/// Draws boxes about points: the one of least area, of 18 directions, with nearly all of them in
/// each extent, so that single wrong readings do not count. Of more than some thousand points a
/// part is looked at.
class BoxFitter {
 public:
  /// @pre there is a point.
  UprightBox fit(const ObstaclePoint* first, const ObstaclePoint* last);

 private:
  /// Where nearly all of some values are.
  struct Extent {
    float low = 0.0F, high = 0.0F;
    float size() const { return high - low; }
    float middle() const { return 0.5F * (low + high); }
  };

  template <typename Value>
  Extent extentOf(Value&& value);

  std::vector<ObstaclePoint> sample_;
  std::vector<float> values_;
  std::vector<int> bins_;
};

}  // namespace dominant_plane_detection
