#include "core/kdtree_region_growing.h"

#include <algorithm>
#include <cmath>

namespace dominant_plane_detection {
namespace {

/// Bounds have to hold by more than rounding could take from them.
constexpr double kRounding = 1e-6;
/// [#] neighbours of a member that are searched for at most.
constexpr std::uint32_t kFewest = 2, kMostNeighbours = 64;

/// Order of a heap with the nearest candidate on top; of equally near ones, that of lower index.
constexpr auto later = [](const auto& a, const auto& b) { return b.neighbour < a.neighbour; };

}  // namespace

void KdtreeRegionGrowing::setPoints(const std::vector<Eigen::Vector3d>& points) {
  points_ = points;
  tree_.build(points_);
  effort_ = Effort();
}

const KdtreeRegionGrowing::Region& KdtreeRegionGrowing::grow(
    const std::array<std::size_t, 3>& seeds, const GrowthThresholds& thresholds,
    const Check& worthwhile) {
  region_.sequence.clear();
  region_.moments = PlaneMoments();
  sum_epsilon2_ = 0.0;
  members_.clear();
  neighbours_.clear();
  queue_.clear();
  rejected_.clear();

  for (const std::size_t seed : seeds) tree_.remove(seed);
  for (const std::size_t seed : seeds) join(seed, thresholds);
  if (!region_.moments.fit()) return region_;
  decompose();
  std::size_t next_check = kFirstCheck;
  while (!queue_.empty()) {
    const Candidate nearest = pop();
    const std::size_t point = nearest.neighbour.point;
    // Another member may have been as near to it, or nearer.
    if (tree_.contains(point)) {
      tree_.remove(point);
      ++members_[nearest.member].used;
      if (test(point, thresholds)) {
        join(point, thresholds);
      } else {
        rejected_.push_back(point);
      }
    }
    offerNearest(nearest.member, thresholds);
    if (region_.sequence.size() < next_check) continue;
    if (!worthwhile(region_.moments)) break;
    next_check *= 2;
  }
  for (const std::size_t point : rejected_) tree_.restore(point);
  return region_;
}

/// Adds a point to the region, and the one next to it to the candidates.
void KdtreeRegionGrowing::join(std::size_t point, const GrowthThresholds& thresholds) {
  const Eigen::Vector3d& r = points_[point];
  const double epsilon = thresholds.epsilon.at(r.z(), thresholds.noise);
  sum_epsilon2_ += epsilon * epsilon;
  region_.moments.add(r);  // Eq. 10
  region_.sequence.push_back(point);
  refit_is_current_ = false;
  members_.push_back({static_cast<std::uint32_t>(point)});
  offerNearest(static_cast<std::uint32_t>(members_.size() - 1), thresholds);
}

/// Puts the nearest untested point within delta of a member into the queue. What a member offered
/// before is a lower bound of what it offers now, so that one offer of each member is enough.
void KdtreeRegionGrowing::offerNearest(std::uint32_t member, const GrowthThresholds& thresholds) {
  Member& m = members_[member];
  while (true) {
    while (m.next < m.end && !tree_.contains(neighbours_[m.next].point)) ++m.next;
    if (m.next < m.end) return push({neighbours_[m.next++], member});
    if (m.complete) return;
    searchNeighbours(m, thresholds);
  }
}

void KdtreeRegionGrowing::searchNeighbours(Member& member, const GrowthThresholds& thresholds) {
  ++effort_.searches;
  const Eigen::Vector3d& r = points_[member.point];
  const double delta = thresholds.delta.at(r.z(), thresholds.noise);
  // A member with many neighbours of its own needs few searches; one whose neighbours are nearer to
  // others needs cheap ones.
  const bool were_own = 2 * member.used > member.asked;
  member.asked =
      std::clamp(were_own ? 2 * member.asked : member.asked / 2, kFewest, kMostNeighbours);
  member.used = 0;
  tree_.nearest(r, delta * delta, member.asked, found_);
  member.complete = found_.size() < member.asked;
  member.next = static_cast<std::uint32_t>(neighbours_.size());
  neighbours_.insert(neighbours_.end(), found_.begin(), found_.end());
  member.end = static_cast<std::uint32_t>(neighbours_.size());
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
  if (const std::optional<bool> passes = settledByRefit(r, gamma, sum_epsilon2)) return *passes;

  ++effort_.decompositions;
  const std::optional<PlaneFit> fit = with_point.fit();
  return fit && fit->mean_square_error * with_point.count() < sum_epsilon2 &&
         std::abs(fit->plane.signedDistance(r)) < gamma;
}

void KdtreeRegionGrowing::decompose() {
  ++effort_.decompositions;
  refit_.setRegion(region_.moments);
  refit_is_current_ = true;
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
  const Eigen::Vector3d m = refit_.normal();
  const double sum_squares = m.dot(with_point.scatter() * m);
  if (!(sum_squares < (1.0 - kRounding) * sum_epsilon2)) return false;
  const double lambda_1 = refit_.eigenvalues()[0], lambda_2 = refit_.eigenvalues()[1];
  const double sin2 = std::clamp((sum_squares - lambda_1) / (lambda_2 - lambda_1), 0.0, 1.0);
  const Eigen::Vector3d from_centre = point - with_point.centre();
  const double distance = std::abs(m.dot(from_centre)) + std::sqrt(sin2) * from_centre.norm();
  return distance < (1.0 - kRounding) * gamma;
}

/// @return what both tests say, or nothing where rounding might decide.
std::optional<bool> KdtreeRegionGrowing::settledByRefit(const Eigen::Vector3d& point, double gamma,
                                                        double sum_epsilon2) {
  if (!refit_is_current_) decompose();
  const std::optional<PointRefit::Fit> fit = refit_.with(point);
  if (!fit) return std::nullopt;
  const double excess = fit->sum_squares - sum_epsilon2;
  const double excess_distance = fit->distance - gamma;
  const double tolerance = kRounding * sum_epsilon2 + refit_.rounding();
  if (excess > tolerance || excess_distance > kRounding * gamma) return false;
  if (excess < -tolerance && excess_distance < -kRounding * gamma) return true;
  return std::nullopt;
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
