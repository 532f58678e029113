#pragma once

#include <vector>

#include "core/ray_table.h"
#include "dominant_plane_detection/depth_image.h"
#include "dominant_plane_detection/detection.h"
#include "dominant_plane_detection/noise_model.h"
#include "navigation/connected_obstacles.h"
#include "navigation/obstacle_limits.h"
#include "navigation/upright_box.h"

namespace dominant_plane_detection {

/// Finds connected obstacles as things, and draws each as an upright box. What reaches down to the
/// ground needs a steep face, and to be higher than the error of the ground there (`toldHeight`): a
/// floor that the camera's error bends has none. What is longer than 1.2 and wider than 0.4 m is
/// divided: walls that meet in a corner would have half the room in their box.
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
  float areaOf(const ObstaclePoint* first, const ObstaclePoint* last) const;
  bool isThing(const ObstaclePoint* first, const ObstaclePoint* last, const ObstacleLimits& limits,
               const NoiseModel& local_error) const;
  void draw(ObstaclePoint* first, ObstaclePoint* last, const ObstacleLimits& limits);

  ConnectedObstacles things_;
  BoxFitter fitter_;
  std::vector<UprightBox> boxes_;
};

}  // namespace dominant_plane_detection
