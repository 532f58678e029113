#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/growth_thresholds.h"
#include "core/plane_moments.h"

namespace dominant_plane_detection {

/// Algorithm 1: grows a plane point by point, nearest candidates first.
///
/// The region starts as {r1, r2, r3}. Candidates are the points closer than delta(z_p) to a point p
/// of the region; they are tested once each, in the order (distance to the region, index). A
/// candidate r joins when the region with r has a mean square error (Eq. 8) below the mean of
/// epsilon(z_i)^2 over its points, and r is closer than gamma(z_r) to the plane refitted with r.
/// Every point that joins updates the moments by Eq. 10; bounds save the eigen-decompositions that
/// would change no decision, and most of a delta-ball is searched only when everything nearer was
/// tested, among the few points that are left by then.
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
  class Neighbours;  // a k-d tree

  /// A candidate and its squared distance to the region when it was put into the queue.
  struct Candidate {
    double squared_distance;  ///< [m^2]
    std::size_t point;
  };

  void join(std::size_t point, const GrowthThresholds& thresholds);
  void offerNeighbours(std::size_t point, double radius);
  bool nearestIsCertain() const;
  void searchWhatWasDeferred(const GrowthThresholds& thresholds);
  bool test(std::size_t point, const GrowthThresholds& thresholds);
  bool settledByBounds(const PlaneMoments& with_point, const Eigen::Vector3d& point, double gamma,
                       double sum_epsilon2) const;
  void push(const Candidate& candidate);
  Candidate pop();

  std::unique_ptr<Neighbours> all_;
  std::unique_ptr<Neighbours> untested_;  ///< points that were untested when it was built
  const Neighbours* searched_ = nullptr;  ///< one of the two
  std::vector<Eigen::Vector3d> points_;   ///< [m]
  std::vector<double> key_;  ///< [m^2] squared distance to the region; -1 once it was tested
  std::vector<Candidate> queue_;
  std::vector<std::size_t> deferred_;  ///< region points whose ball was searched in part only
  double squared_horizon_ = 0.0;  ///< [m^2] up to which the balls of all of these were searched
  Region region_;
  PlaneFit fit_{};             ///< of the last decomposition
  double sum_epsilon2_ = 0.0;  ///< [m^2] over the region's points
  Effort effort_;
};

}  // namespace dominant_plane_detection
