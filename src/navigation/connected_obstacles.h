#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"
#include "navigation/obstacle_limits.h"

namespace dominant_plane_detection {

/// A reading of an obstacle.
struct ObstaclePoint {
  float x, y, height;   ///< [m] in the frame on the ground (`groundFromOptical`)
  float z;              ///< [m] depth
  bool steep;           ///< part of a steep face
  std::uint32_t thing;  ///< another point of the same thing, itself for one of them
};

/// Sorts the readings of obstacles by the things that they are of: neighbouring pixels are of one
/// where their readings are, in depth or, on its top that is seen at a low angle, in height. What
/// rises slowly from where the floor ends is of none: a floor that the camera's error bends.
class ConnectedObstacles {
 public:
  static constexpr int kStep = 2;  ///< [px] from one pixel that is looked at to the next

  /// @param rays of the detection's camera. @pre detection.found()
  void find(const DepthView& depth, const RayTable& rays, const Detection& detection,
            const ObstacleLimits& limits);

  /// @return [#] of things.
  std::size_t size() const { return begins_.size() - 1; }
  ObstaclePoint* begin(std::size_t thing) { return sorted_.data() + begins_[thing]; }
  ObstaclePoint* end(std::size_t thing) { return sorted_.data() + begins_[thing + 1]; }
  /// @return [-] the area that a point stands for, seen from the camera, at a depth of 1.
  float pixelArea() const { return pixel_area_; }
  /// @return whether the camera looks so steeply down that nothing shows its sides.
  bool looksDown() const { return down_.isZero(); }

 private:
  struct Image {
    const DepthView& depth;
    const RayTable& rays;
    const Detection& detection;
  };

  void setView(const Image& image);
  void collect(const Image& image, const ObstacleLimits& limits);
  Eigen::Vector2i pixelOf(int across, int line) const;
  std::size_t nodeOf(int across, int line) const {
    return static_cast<std::size_t>(line * width_ + across);
  }
  bool isSteep(const Image& image, const Eigen::Vector2i& pixel) const;
  bool risesFromFloor(const ObstaclePoint& point, int across, int line) const;
  void connect(int across, int line);
  void link(std::uint32_t a, std::uint32_t b);
  std::uint32_t thingOf(std::uint32_t point);
  void sortPoints();

  Eigen::Matrix3f rotation_ = Eigen::Matrix3f::Identity();  ///< R_ground_optical
  float height_ = 0.0F;                                     ///< [m] of the camera
  float pixel_area_ = 0.0F;
  /// [px] the step towards the ground along rows or columns, whichever the camera's roll has more
  /// upright; 0 where it looks down. Lines are across it, the lowest first.
  Eigen::Vector2i down_ = Eigen::Vector2i::UnitY();
  int width_ = 0, lines_ = 0;         ///< [#] of pixels that are looked at, in a line, and of lines
  std::vector<std::uint32_t> nodes_;  ///< for each of these, the number of its point + 1, or 0
  std::vector<float> floor_;          ///< [m] height of these where they are floor
  std::vector<ObstaclePoint> points_, sorted_;
  std::vector<std::uint32_t> begins_{0};  ///< of each thing's points
};

}  // namespace dominant_plane_detection
