#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "support/surface_figures.h"

namespace dominant_plane_detection {

/// How maps hold against the floor plans of rooms that a robot drives through, by exact images and
/// plans alone.
///
/// A robot with a Kinect 0.45 m up that looks down by 20 degrees goes round in a closed room with
/// boxes, posts, tables and flat things in it, at 0.45 m/s. Its odometry errs by up to 1 % of the
/// way and of the turn. A cell counts that was seen in three images of the last ten seconds, the
/// floor where 5 cm are told; the plan lies where odometry has the robot now.
struct MapFigures {
  int maps = 0;                           ///< [#] that were held against the plan
  double least_iou = 1.0, sum_iou = 0.0;  ///< [-] of free cells, within one cell
  /// [#] cells in which half their area of things of 5 cm or more was seen in three images; and
  /// those that are free, with no occupied one about them
  int obstacle_cells = 0, left_free = 0;
  /// [#] things of 5 cm or more of which 5 x 5 cm were seen in three images, and those without an
  /// occupied cell
  int things = 0, missed = 0;
  double sum_milliseconds = 0.0;  ///< of adding an image
  int images = 0;
};

/// @param seed of the room. @param seconds [s] @param rate [1/s] of images.
/// @param picture a file for the last map beside the plan; empty: none.
MapFigures driveThroughRoom(std::uint32_t seed, ErrorKind error, double seconds, double rate,
                            const std::string& picture = "");

}  // namespace dominant_plane_detection
