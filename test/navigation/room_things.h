#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "synthetic/scene.h"

namespace dominant_plane_detection {

/// Something that stands on the floor: a box, or a post, whose diameter is its length.
struct Thing {
  Eigen::Vector2d place;  ///< [m]
  double yaw;             ///< [rad]
  Eigen::Vector3d size;   ///< [m]
  bool round;

  /// @return where a point is from its middle, in its own axes [m].
  Eigen::Vector2d inside(const Eigen::Vector2d& point) const {
    return Eigen::Rotation2Dd(-yaw) * (point - place);
  }
  /// @return [m] of a point on the floor from it; 0 below it.
  double distanceTo(const Eigen::Vector2d& point) const;
  bool contains(const Eigen::Vector3d& point) const;
};

void addThing(Scene& scene, const Thing& thing);

struct RoomOfThings {
  Scene scene;
  std::vector<Thing> things;
};

/// A camera 0.4 to 1 m up that looks down by 20 degrees and is rolled by 10; boxes and posts of
/// 0.02 to 0.6 m stand 0.8 to 3.5 m ahead of it, walls farther away.
/// @param apart [m] that these are at least from each other.
RoomOfThings roomOfThings(std::uint32_t seed, double apart = 0.0);

}  // namespace dominant_plane_detection
