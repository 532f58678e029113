#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/noise_model.h"
#include "navigation/obstacle_limits.h"

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

/// Finds connected obstacles as things.
///
/// Neighbouring pixels are of one thing where their readings are, in depth or, on its top that is
/// seen at a low angle, in height. A thing is drawn as the upright box of least area that has
/// nearly all of its readings. What reaches down to the ground needs a steep face, and to be higher
/// than the error of the ground there (`toldHeight`): a floor that the camera's error bends has
/// none.
class ObstacleBoxes {
 public:
  /// @param rays of the detection's camera.
  /// @param local_error rms of 4 x 4 pixels over the ground about them.
  /// @return in the frame on the ground (`groundFromOptical`), the nearest first; none without a
  /// plane. Valid until the next call.
  const std::vector<UprightBox>& find(const DepthView& depth, const RayTable& rays,
                                      const Detection& detection, const ObstacleLimits& limits,
                                      const NoiseModel& local_error);

 private:
  /// A reading of an obstacle.
  struct Point {
    float x, y, height;   ///< [m] in the frame on the ground
    float z;              ///< [m] depth
    bool steep;           ///< part of a steep face
    std::uint32_t thing;  ///< another point of the same thing, itself for one of them
  };

  void begin(const RayTable& rays, const Detection& detection);
  void collect(const DepthView& depth, const RayTable& rays, const Detection& detection,
               const ObstacleLimits& limits);
  std::size_t nodeOf(int column, int row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  bool risesFromFloor(const Point& point, int column, int row) const;
  void connect(int column, int row);
  void link(std::uint32_t a, std::uint32_t b);
  std::uint32_t thingOf(std::uint32_t point);
  void sortPoints();
  float areaOf(const Point* first, const Point* last) const;
  bool isThing(const Point* first, const Point* last, const NoiseModel& local_error);
  UprightBox boxOf(const Point* first, const Point* last);
  void measure(Point* first, Point* last);

  Eigen::Matrix3f rotation_ = Eigen::Matrix3f::Identity();  ///< R_ground_optical
  float height_ = 0.0F;                                     ///< [m] of the camera
  int columns_ = 0, rows_ = 0;                              ///< [#] of pixels that are looked at
  float pixel_ = 0.0F;                ///< [-] area of such a pixel at a depth of 1
  std::vector<std::uint32_t> nodes_;  ///< for each of these, the number of its point + 1, or 0
  std::vector<float> floor_;          ///< [m] height of these where they are floor
  std::vector<Point> points_, sorted_, sample_;
  std::vector<std::uint32_t> begins_;  ///< of each thing's points
  std::vector<int> bins_;
  std::vector<UprightBox> boxes_;
};

}  // namespace dominant_plane_detection
