#include "core/kdtree_region_growing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <tuple>

namespace dominant_plane_detection {
namespace {

constexpr double kTested = -1.0;
/// Bounds have to hold by more than rounding could take from them.
constexpr double kRounding = 1e-6;
/// Share of delta that is searched when a point joins; the rest of the ball is deferred.
constexpr double kNearShare = 1.0 / 3.0;
/// Searches that cost as much as putting this many points into a tree of their own.
constexpr std::size_t kPointsPerSearch = 10;

/// Order of a heap with the nearest candidate on top; of equally near ones, that of lower index.
constexpr auto later = [](const auto& a, const auto& b) {
  return std::tie(a.squared_distance, a.point) > std::tie(b.squared_distance, b.point);
};

/// Hands every point in a ball to a function; what nanoflann calls a result set.
template <typename Function>
class BallVisitor {
 public:
  BallVisitor(double squared_radius, Function function)
      : squared_radius_(squared_radius), function_(function) {}

  bool addPoint(double squared_distance, std::size_t point) {
    if (squared_distance < squared_radius_) function_(squared_distance, point);
    return true;
  }
  double worstDist() const { return squared_radius_; }
  bool full() const { return true; }
  std::size_t size() const { return 0; }

 private:
  double squared_radius_;
  Function function_;
};

}  // namespace

class KdtreeRegionGrowing::Neighbours {
 public:
  /// Takes the points whose index satisfies `wanted`; copied, so that they lie side by side.
  template <typename Predicate>
  void build(const std::vector<Eigen::Vector3d>& points, Predicate wanted) {
    points_.clear();
    indices_.clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!wanted(i)) continue;
      points_.push_back(points[i]);
      indices_.push_back(i);
    }
    tree_.buildIndex();
  }

  /// Calls function(squared distance, index) for the points closer than `radius` to `centre`.
  template <typename Function>
  void visit(const Eigen::Vector3d& centre, double radius, Function function) const {
    const auto visit_index = [&](double squared_distance, std::size_t point) {
      function(squared_distance, indices_[point]);
    };
    BallVisitor<decltype(visit_index)> visitor(radius * radius, visit_index);
    tree_.findNeighbors(visitor, centre.data(), nanoflann::SearchParams());
  }

 private:
  static constexpr std::size_t kLeafSize = 16;

  /// The interface that nanoflann reads points through.
  struct Adaptor {
    const std::vector<Eigen::Vector3d>& points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t point, std::size_t axis) const {
      return points[point][static_cast<Eigen::Index>(axis)];
    }
    template <typename BoundingBox>
    bool kdtree_get_bbox(BoundingBox&) const {
      return false;
    }
  };
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Adaptor>,
                                                   Adaptor, 3, std::size_t>;
  std::vector<Eigen::Vector3d> points_;  ///< [m]
  std::vector<std::size_t> indices_;     ///< of these among all points
  Adaptor adaptor_{points_};
  Tree tree_{3, adaptor_, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)};
};

KdtreeRegionGrowing::KdtreeRegionGrowing()
    : all_(std::make_unique<Neighbours>()), untested_(std::make_unique<Neighbours>()) {}
KdtreeRegionGrowing::~KdtreeRegionGrowing() = default;

void KdtreeRegionGrowing::setPoints(const std::vector<Eigen::Vector3d>& points) {
  points_ = points;
  all_->build(points_, [](std::size_t) { return true; });
}

const KdtreeRegionGrowing::Region& KdtreeRegionGrowing::grow(
    const std::array<std::size_t, 3>& seeds, const GrowthThresholds& thresholds) {
  region_.sequence.clear();
  region_.moments = PlaneMoments();
  sum_epsilon2_ = 0.0;
  effort_ = Effort();
  key_.assign(points_.size(), std::numeric_limits<double>::infinity());
  queue_.clear();
  deferred_.clear();
  squared_horizon_ = std::numeric_limits<double>::infinity();
  searched_ = all_.get();

  for (const std::size_t seed : seeds) key_[seed] = kTested;
  for (const std::size_t seed : seeds) join(seed, thresholds);
  const std::optional<PlaneFit> fit = region_.moments.fit();
  if (!fit) return region_;
  fit_ = *fit;
  while (true) {
    if (!nearestIsCertain()) searchWhatWasDeferred(thresholds);
    if (queue_.empty()) return region_;
    const Candidate nearest = pop();
    // A candidate that came closer while it waited stands in the queue twice.
    if (nearest.squared_distance != key_[nearest.point]) continue;
    key_[nearest.point] = kTested;
    if (test(nearest.point, thresholds)) join(nearest.point, thresholds);
  }
}

/// Adds a point to the region, and the points near it to the candidates. The rest of its ball can
/// wait: by the time it matters, most of the points in it will have been tested from nearer by.
void KdtreeRegionGrowing::join(std::size_t point, const GrowthThresholds& thresholds) {
  const Eigen::Vector3d& r = points_[point];
  const double epsilon = thresholds.epsilon.at(r.z(), thresholds.noise);
  sum_epsilon2_ += epsilon * epsilon;
  region_.moments.add(r);  // Eq. 10
  region_.sequence.push_back(point);
  const double near = kNearShare * thresholds.delta.at(r.z(), thresholds.noise);
  offerNeighbours(point, near);
  deferred_.push_back(point);
  squared_horizon_ = std::min(squared_horizon_, near * near);
}

/// Makes candidates of the points closer than `radius` to a point of the region.
void KdtreeRegionGrowing::offerNeighbours(std::size_t point, double radius) {
  searched_->visit(points_[point], radius, [&](double squared_distance, std::size_t neighbour) {
    if (squared_distance >= key_[neighbour]) return;
    key_[neighbour] = squared_distance;
    push({squared_distance, neighbour});
  });
}

/// @return whether no ball that was searched in part only can hold a nearer candidate than the
/// queue does.
bool KdtreeRegionGrowing::nearestIsCertain() const {
  return deferred_.empty() ||
         (!queue_.empty() && queue_.front().squared_distance < squared_horizon_);
}

void KdtreeRegionGrowing::searchWhatWasDeferred(const GrowthThresholds& thresholds) {
  const std::size_t left = points_.size() - effort_.tests;
  if (kPointsPerSearch * deferred_.size() > left) {
    untested_->build(points_, [this](std::size_t point) { return key_[point] != kTested; });
    searched_ = untested_.get();
  }
  for (const std::size_t point : deferred_) {
    offerNeighbours(point, thresholds.delta.at(points_[point].z(), thresholds.noise));
  }
  deferred_.clear();
  squared_horizon_ = std::numeric_limits<double>::infinity();
}

/// @return whether the point may join: both tests of Algorithm 1, against the plane refitted with
/// it.
bool KdtreeRegionGrowing::test(std::size_t point, const GrowthThresholds& thresholds) {
  ++effort_.tests;
  const Eigen::Vector3d& r = points_[point];
  const double gamma = thresholds.gamma.at(r.z(), thresholds.noise);
  const double epsilon = thresholds.epsilon.at(r.z(), thresholds.noise);
  const double sum_epsilon2 = sum_epsilon2_ + epsilon * epsilon;
  PlaneMoments with_point = region_.moments;
  with_point.add(r);
  if (settledByBounds(with_point, r, gamma, sum_epsilon2)) return true;

  ++effort_.decompositions;
  const std::optional<PlaneFit> fit = with_point.fit();
  if (!fit || fit->mean_square_error * with_point.count() >= sum_epsilon2 ||
      std::abs(fit->plane.signedDistance(r)) >= gamma) {
    return false;
  }
  fit_ = *fit;
  return true;
}

/// Whether both tests are passed for certain, judged by the plane of the last decomposition, with
/// normal m and smallest eigenvalues lambda_1, lambda_2, which can only have grown since. With A'
/// the scatter of region and point, and n' its unknown normal:
///   lambda_min(A') <= m^T A' m, which bounds the mean square error;
///   sin^2(m, n') <= (m^T A' m - lambda_1) / (lambda_2 - lambda_1), which bounds the distance to
///   the refitted plane by |m . (r - g')| + sin(m, n') |r - g'|.
bool KdtreeRegionGrowing::settledByBounds(const PlaneMoments& with_point,
                                          const Eigen::Vector3d& point, double gamma,
                                          double sum_epsilon2) const {
  const Eigen::Vector3d& m = fit_.plane.normal;
  const double sum_squares = m.dot(with_point.scatter() * m);
  if (!(sum_squares < (1.0 - kRounding) * sum_epsilon2)) return false;
  const double lambda_1 = fit_.eigenvalues[0], lambda_2 = fit_.eigenvalues[1];
  const double sin2 = std::clamp((sum_squares - lambda_1) / (lambda_2 - lambda_1), 0.0, 1.0);
  const Eigen::Vector3d from_centre = point - with_point.centre();
  const double distance = std::abs(m.dot(from_centre)) + std::sqrt(sin2) * from_centre.norm();
  return distance < (1.0 - kRounding) * gamma;
}

void KdtreeRegionGrowing::push(const Candidate& candidate) {
  queue_.push_back(candidate);
  std::push_heap(queue_.begin(), queue_.end(), later);
}

KdtreeRegionGrowing::Candidate KdtreeRegionGrowing::pop() {
  std::pop_heap(queue_.begin(), queue_.end(), later);
  const Candidate nearest = queue_.back();
  queue_.pop_back();
  return nearest;
}

}  // namespace dominant_plane_detection
