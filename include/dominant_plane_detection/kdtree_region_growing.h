#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "dominant_plane_detection/noise_model.h"
#include "dominant_plane_detection/plane_moments.h"

namespace dominant_plane_detection {

/// When a candidate may join a region (section III.B). Constant in the paper, here of the depth z.
struct GrowthThresholds {
  NoiseModel noise;
  DepthThreshold delta;    ///< [m] farthest from the region's nearest point
  DepthThreshold epsilon;  ///< [m] square root of the largest mean square error
  DepthThreshold gamma;    ///< [m] farthest from the plane refitted with the candidate
};

/// Algorithm 1: grows a plane point by point, nearest candidates first.
///
/// The region starts as {r1, r2, r3}. Candidates are the points closer than delta(z_p) to a point p
/// of the region; they are tested once each, in the order (distance to the region, index). A
/// candidate r joins when the region with r has a mean square error (Eq. 8) below the mean of
/// epsilon(z_i)^2 over its points, and r is closer than gamma(z_r) to the plane refitted with r.
/// Every point that joins updates the moments by Eq. 10; bounds save the eigen-decompositions that
/// would change no decision.
class KdtreeRegionGrowing {
 public:
  struct Region {
    std::vector<std::size_t> sequence;  ///< indices in the order they joined, the seeds first
    PlaneMoments moments;
  };

  KdtreeRegionGrowing();
  ~KdtreeRegionGrowing();

  /// @param points [m] in the optical frame, all finite; copied.
  void setPoints(const std::vector<Eigen::Vector3d>& points);

  /// @param seeds three different indices into the points.
  /// @return valid until the next call. Only the seeds when they lie on a line, where no plane can
  /// be fitted, or when nothing can join.
  const Region& grow(const std::array<std::size_t, 3>& seeds, const GrowthThresholds& thresholds);

  /// [#] What the last `grow` cost.
  struct Effort {
    std::size_t tests = 0;
    std::size_t decompositions = 0;
  };
  const Effort& effort() const { return effort_; }

 private:
  class Neighbours;  // the k-d tree

  /// A candidate and its squared distance to the region when it was put into the queue.
  struct Candidate {
    double squared_distance;  ///< [m^2]
    std::size_t point;
  };

  void join(std::size_t point, const GrowthThresholds& thresholds);
  bool test(std::size_t point, const GrowthThresholds& thresholds);
  bool settledByBounds(const PlaneMoments& with_point, const Eigen::Vector3d& point, double gamma,
                       double sum_epsilon2) const;
  void push(const Candidate& candidate);
  Candidate pop();

  std::unique_ptr<Neighbours> neighbours_;
  std::vector<Eigen::Vector3d> points_;  ///< [m]
  std::vector<double> key_;  ///< [m^2] squared distance to the region; -1 once it was tested
  std::vector<Candidate> queue_;
  Region region_;
  PlaneFit fit_{};             ///< of the last decomposition
  double sum_epsilon2_ = 0.0;  ///< [m^2] over the region's points
  Effort effort_;
};

}  // namespace dominant_plane_detection
