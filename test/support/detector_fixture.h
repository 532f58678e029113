#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/synthetic_depth.h"

namespace dominant_plane_detection {

inline const Eigen::Vector3d kUp = upOf(0.5, 0.1);
constexpr double kHeight = 0.8;

inline double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::min(a.dot(b), 1.0));
}

/// A floor with a wall-to-wall box across the view: the floor behind it is cut off.
inline OwnedDepth<float> cutFloor(const CameraModel& camera) {
  OwnedDepth<float> depth = planeDepth(camera, kUp, kHeight);
  for (int v = camera.height / 2; v < camera.height / 2 + camera.height / 8; ++v) {
    for (int u = 0; u < camera.width; ++u) depth.at(u, v) *= 0.6F;
  }
  return depth;
}

class DetectorAlgorithm : public testing::TestWithParam<Algorithm> {
 protected:
  DetectorAlgorithm() { parameters_.algorithm = GetParam(); }
  Parameters parameters_;
};

}  // namespace dominant_plane_detection
