#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/growth_thresholds.h"
#include "core/plane_moments.h"
#include "core/point_refit.h"
#include "core/point_tree.h"

namespace dominant_plane_detection {

/// Algorithm 1: grows a plane point by point, nearest candidates first.
///
/// The region starts as {r1, r2, r3}. Candidates are the points closer than delta(z_p) to a point p
/// of the region; they are tested once each, in the order (distance to the region, index). A
/// candidate r joins when the region with r has a mean square error (Eq. 8) below the mean of
/// epsilon(z_i)^2 over its points, and r is closer than gamma(z_r) to the plane refitted with r.
/// Every point that joins updates the moments by Eq. 10; bounds save the eigen-decompositions that
/// would change no decision. The points of a region are claimed: they are no candidates of later
/// ones, so that all regions together hold each point at most once.
class KdtreeRegionGrowing {
 public:
  struct Region {
    std::vector<std::size_t> sequence;  ///< indices in the order they joined, the seeds first
    PlaneMoments moments;
  };

  /// @return whether a region is worth growing on.
  using Check = std::function<bool(const PlaneMoments& moments)>;
  /// [#] Size of a region when it is checked first, and then each time it has doubled. Of regions
  /// of three points of a floor, a quarter is tilted by more than 20 degrees; noise is to decide
  /// nothing.
  static constexpr std::size_t kFirstCheck = 200;

  /// Claims are forgotten.
  /// @param points [m] in the optical frame, all finite; copied.
  void setPoints(const std::vector<Eigen::Vector3d>& points);

  /// @return [#] points that no region has claimed.
  std::size_t unclaimed() const { return tree_.size(); }
  bool claimed(std::size_t point) const { return !tree_.contains(point); }

  /// Grows a region and claims its points, whatever becomes of it.
  /// @param seeds three different indices of points that are not claimed.
  /// @return valid until the next call. Only the seeds when they lie on a line, where no plane can
  /// be fitted, or when nothing can join.
  const Region& grow(
      const std::array<std::size_t, 3>& seeds, const GrowthThresholds& thresholds,
      const Check& worthwhile = [](const PlaneMoments&) { return true; });

  /// [#] What all growing since `setPoints` has cost.
  struct Effort {
    std::size_t tests = 0;
    std::size_t decompositions = 0;
    std::size_t searches = 0;  ///< in the k-d tree
  };
  const Effort& effort() const { return effort_; }

 private:
  /// [#] neighbours of a member that are searched for at first.
  static constexpr std::uint32_t kFirstNeighbours = 4;

  /// A point of the region with the nearest points that were left when the tree was searched.
  struct Member {
    std::uint32_t point;
    std::uint32_t next = 0;                  ///< of its neighbours
    std::uint32_t end = 0;                   ///< of its neighbours
    std::uint32_t asked = kFirstNeighbours;  ///< [#] neighbours that were searched for
    std::uint32_t used = 0;                  ///< [#] of these that were tested as its neighbours
    bool complete = false;                   ///< whether there were no more
  };
  /// A member's nearest neighbour that may still be untested.
  struct Candidate {
    Neighbour neighbour;
    std::uint32_t member;
  };

  void join(std::size_t point, const GrowthThresholds& thresholds);
  void offerNearest(std::uint32_t member, const GrowthThresholds& thresholds);
  void searchNeighbours(Member& member, const GrowthThresholds& thresholds);
  void decompose();
  bool test(std::size_t point, const GrowthThresholds& thresholds);
  bool settledByBounds(const PlaneMoments& with_point, const Eigen::Vector3d& point, double gamma,
                       double sum_epsilon2) const;
  std::optional<bool> settledByRefit(const Eigen::Vector3d& point, double gamma,
                                     double sum_epsilon2);
  void push(const Candidate& candidate);
  Candidate pop();

  std::vector<Eigen::Vector3d> points_;  ///< [m]
  PointTree tree_;                       ///< of the points that are neither tested nor claimed
  std::vector<Member> members_;          ///< in the order they joined
  std::vector<Neighbour> neighbours_;    ///< of all members
  std::vector<Neighbour> found_;
  std::vector<Candidate> queue_;
  std::vector<std::size_t> rejected_;
  Region region_;
  PointRefit refit_;  ///< of the region, or of what it was at an earlier point
  bool refit_is_current_ = false;
  double sum_epsilon2_ = 0.0;  ///< [m^2] over the region's points
  Effort effort_;
};

}  // namespace dominant_plane_detection
