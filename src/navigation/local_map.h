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
#include "navigation/rolling_grid.h"

namespace dominant_plane_detection {

struct MapLimits : ObstacleLimits {
  bool missing_ground = false;  ///< missing ground is occupied
  NoiseModel noise;             ///< of the readings
  double free_range = 4.0;      ///< [m] depth of the farthest ground that makes a cell free
};

/// A square of the ground about the camera, which moves with it: what is free, what stands there,
/// what was not seen (A. Elfes, "Using occupancy grids for mobile robot perception and navigation",
/// Computer 22(6), 1989; limits and increments of the log-odds as in A. Hornung et al., "OctoMap",
/// Auton. Robots 34, 2013).
///
/// A cell has two log-odds. That of its surface says whether there is ground: an image is asked
/// what it shows where the cell is on the plane. That of things says whether something stands or
/// hangs over it: readings add to it, and only who looks through the place where it was takes from
/// it, so that floor seen below a table does not make the table go away. What is not seen fades at
/// the pace at which odometry goes wrong, into what is not known, never into what is free.
class LocalMap {
 public:
  enum State : std::int8_t { kUnknown = -1, kFree = 0, kOccupied = 100 };

  /// @param resolution [m] side of a cell. @param size [m] side of the square, rounded to cells.
  /// @param memory [s] in which what is known fades to 1/e; 0: each image is by itself.
  LocalMap(double resolution, double size, double memory);

  /// Adds an image; of an earlier stamp than the last, everything before it is forgotten.
  /// @param stamp [s] @param rays of the detection's camera.
  /// @param T_map_ground of the frame on the ground below the camera (`groundFromOptical`).
  /// @pre detection.found()
  void add(double stamp, const DepthView& depth, const RayTable& rays, const Detection& detection,
           const MapLimits& limits, const Eigen::Isometry2d& T_map_ground);
  /// Lets time pass without an image.
  void age(double stamp);
  void reset();

  const RollingGrid& grid() const { return grid_; }
  /// @param x, y [#] of a cell, from the grid's origin on.
  State state(int x, int y) const;

 private:
  struct Cell {
    float surface = 0.0F;                 ///< log-odds that it is no ground
    float thing = 0.0F;                   ///< log-odds that something is there; 0: nothing is known
    float lowest = 0.0F, highest = 0.0F;  ///< [m] of that, over the ground
  };
  /// What readings show of a thing in a cell.
  struct Shown {
    float area = 0.0F;  ///< [m^2] as seen from the camera
    float lowest = 0.0F, highest = 0.0F;
  };
  /// What an image shows of the ground of a cell, of four places.
  struct GroundSeen {
    int ground = 0, hole = 0;
  };
  struct Image {
    const DepthView& depth;
    const RayTable& rays;
    const Detection& detection;
    const MapLimits& limits;
  };

  void setView(const Detection& detection, const Eigen::Isometry2d& T_map_ground);
  void collectThings(const Image& image);
  void updateCells(const Image& image);
  void extend(Cell& cell, const Shown& shown) const;
  void update(Cell& cell, const Shown& shown, const GroundSeen& seen, const Image& image,
              const Eigen::Vector2f& place);
  GroundSeen groundAt(const Image& image, const Eigen::Vector3f& middle) const;
  bool seesThrough(const Image& image, const Cell& cell, const Eigen::Vector2f& place) const;
  bool pixelOf(const CameraModel& camera, const Eigen::Vector3f& point, int& u, int& v) const;
  float marginAt(const Image& image, float z) const;
  Eigen::Vector3f inCamera(const Eigen::Vector2f& place, float height) const;

  RollingGrid grid_;
  double memory_;
  double stamp_ = 0.0;
  std::vector<Cell> cells_;
  std::vector<Shown> shown_;  ///< of the image that is added

  // Of the image that is added; places on the ground are from the grid's origin on.
  Eigen::Matrix3f rotation_ = Eigen::Matrix3f::Identity();  ///< R_map_optical
  Eigen::Vector2f foot_ = Eigen::Vector2f::Zero();          ///< [m] below the camera
  float height_ = 0.0F;                                     ///< [m] of the camera
};

}  // namespace dominant_plane_detection
