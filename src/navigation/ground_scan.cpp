#include "navigation/ground_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "navigation/ground_frame.h"

namespace dominant_plane_detection {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr double kIncrement = kPi / 360.0;  // [rad] half a degree
constexpr double kRangeMin = 0.05;          // [m]
constexpr float kCell = 0.025F;             // [m] two of them make a reading
/// [px] from one pixel that is looked at to the next, and the same of ground, of which only its end
/// matters.
constexpr int kStep = 2;
constexpr int kGroundStep = 4;
/// [px] of 640 x 480: half of what a thing 5 cm wide and high shows within half a degree, 2.5 m
/// ahead of a Kinect.
constexpr double kLeastPoints = 28.0;
constexpr std::size_t kCoarse = 4;     // [#] of them, for which it is asked what was seen
constexpr float kSeenToTheEnd = 0.8F;  // [-] of range_max
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

/// @return [rad] to 1e-4, which is faster than the exact one (M. Abramowitz, I. Stegun, 4.4.49).
float angleOf(float x, float y) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float t = std::min(ax, ay) / std::max(std::max(ax, ay), 1e-9F);
  const float s = t * t;
  float angle =
      t * (0.9998660F + s * (-0.3302995F + s * (0.1801410F + s * (-0.0851330F + 0.0208351F * s))));
  if (ay > ax) angle = static_cast<float>(kPi / 2.0) - angle;
  if (x < 0.0F) angle = static_cast<float>(kPi) - angle;
  return y < 0.0F ? -angle : angle;
}

/// @return [rad] the largest angle from straight ahead that the border of an image shows.
double halfWidth(const RayTable& rays, const Eigen::Matrix3f& rotation) {
  const int width = rays.camera().width, height = rays.camera().height;
  float widest = 0.0F;
  const auto look = [&](int u, int v) {
    const Eigen::Vector3f ray = rotation * rays.ray(u, v);
    const float angle = std::abs(angleOf(ray.x(), ray.y()));
    if (!std::isnan(angle)) widest = std::max(widest, angle);
  };
  for (int u = 0; u < width; ++u) {
    look(u, 0);
    look(u, height - 1);
  }
  for (int v = 0; v < height; ++v) {
    look(0, v);
    look(width - 1, v);
  }
  return static_cast<double>(widest);
}

/// @return [m] how far ahead ground can be seen in the image's middle column, from the camera's
/// foot.
float farthestGround(const RayTable& rays, const Eigen::Matrix3f& rotation, float height,
                     float range_max) {
  float farthest = 0.0F;
  for (int v = 0; v < rays.camera().height; ++v) {
    const Eigen::Vector3f ray = rotation * rays.ray(rays.camera().width / 2, v);
    if (!(ray.z() < 0.0F)) continue;
    const float depth = std::min(-height / ray.z(), range_max);
    farthest = std::max(farthest, depth * ray.head<2>().norm());
  }
  return farthest;
}

}  // namespace

void GroundScanner::begin(const RayTable& rays, const Detection& detection,
                          const ScanLimits& limits) {
  const Eigen::Isometry3d frame = groundFromOptical(detection.normal, detection.distance);
  rotation_ = frame.linear().cast<float>();
  height_ = static_cast<float>(detection.distance);
  // In steps of five degrees, so that the scan keeps its form while the plane trembles.
  const double fives = std::ceil(halfWidth(rays, rotation_) / (10.0 * kIncrement));
  const double steps = std::min(10.0 * fives, 359.0);
  scan_.angle_min = -steps * kIncrement;
  scan_.angle_increment = kIncrement;
  scan_.range_min = kRangeMin;
  scan_.range_max = static_cast<double>(
      farthestGround(rays, rotation_, height_, static_cast<float>(limits.range_max)));
  scan_.ranges.assign(static_cast<std::size_t>(2.0 * steps) + 1, kNothing);
  cells_ = static_cast<std::size_t>(std::ceil(2.0F * static_cast<float>(limits.range_max) / kCell));
  grid_.assign(scan_.ranges.size() * cells_, Cell());
  coarse_cells_ = cells_ / kCoarse + 1;
  seen_.assign(scan_.ranges.size() * coarse_cells_, 0);
  unseen_.assign(seen_.size(), 0);
  free_.assign(scan_.ranges.size(), 0.0F);
}

void GroundScanner::addRow(int v, const DepthView& depth, const RayTable& rays,
                           const Detection& detection, const ScanLimits& limits) {
  const auto low = static_cast<float>(limits.clearance_height);
  const auto high = static_cast<float>(limits.max_obstacle_height);
  const auto first = static_cast<float>(scan_.angle_min - 0.5 * kIncrement);
  constexpr auto kPerRadian = static_cast<float>(1.0 / kIncrement);
  for (int u = 0; u < detection.image_width; u += kStep) {
    const Label label = detection.label(u, v);
    const bool between = v % kGroundStep != 0 || u % kGroundStep != 0;
    const bool unseen =
        label == Label::kUnknown || (label == Label::kMissingGround && !limits.missing_ground);
    if ((label == Label::kGround || unseen) && between) continue;
    const Eigen::Vector3f ray = rotation_ * rays.ray(u, v);
    float z = -height_ / ray.z();  // on the plane
    if (label == Label::kObstacle) {
      z = metresAt(depth, u, v);
      const float over = height_ + z * ray.z();
      if (over < low || over > high) continue;
    }
    if (!(z > 0.0F)) continue;
    const float range = z * std::sqrt(ray.x() * ray.x() + ray.y() * ray.y());
    const auto direction =
        static_cast<std::ptrdiff_t>((angleOf(ray.x(), ray.y()) - first) * kPerRadian);
    if (direction < 0 || direction >= static_cast<std::ptrdiff_t>(free_.size())) continue;
    const auto at = static_cast<std::size_t>(direction);
    const auto cell = static_cast<std::size_t>(range / kCell);
    if (cell >= cells_) continue;
    if (label == Label::kGround || unseen) {
      const std::size_t coarse = cell / kCoarse;
      (unseen ? unseen_ : seen_)[at * coarse_cells_ + coarse] += 1;
      if (!unseen) free_[at] = std::max(free_[at], range);
      continue;
    }
    // What lies on the plane shows half as many pixels as what stands on it.
    const std::uint32_t weight = label == Label::kObstacle ? 1 : 2;
    Cell& counted = grid_[at * cells_ + cell];
    counted.points += weight;
    counted.sum += static_cast<float>(weight) * range;
  }
}

/// @return [m] the mean of the nearest two cells that together have points enough.
float GroundScanner::rangeOf(std::size_t direction, std::uint32_t least) const {
  const Cell* const cells = grid_.data() + direction * cells_;
  for (std::size_t i = 0; i + 1 < cells_; ++i) {
    const std::uint32_t points = cells[i].points + cells[i + 1].points;
    if (points >= least) return (cells[i].sum + cells[i + 1].sum) / static_cast<float>(points);
  }
  return kNothing;
}

/// @return whether the ground in a direction was seen to its end, and nowhere more of it not than
/// was.
bool GroundScanner::isFree(std::size_t direction) const {
  constexpr std::uint16_t kFew = 2;  // [#] pixels that are looked at
  if (free_[direction] < kSeenToTheEnd * static_cast<float>(scan_.range_max)) return false;
  const auto end = static_cast<std::size_t>(free_[direction] / kCell) / kCoarse;
  const std::size_t first = direction * coarse_cells_;
  for (std::size_t i = first; i < first + end; ++i) {
    if (unseen_[i] > seen_[i] && unseen_[i] >= kFew) return false;
  }
  return true;
}

const GroundScan& GroundScanner::scan(const DepthView& depth, const RayTable& rays,
                                      const Detection& detection, const ScanLimits& limits) {
  scan_ = GroundScan();
  if (!detection.found()) return scan_;
  begin(rays, detection, limits);
  for (int v = 0; v < detection.image_height; v += kStep) {
    addRow(v, depth, rays, detection, limits);
  }
  const double share = detection.image_width * detection.image_height / (640.0 * 480.0);
  const auto least =
      static_cast<std::uint32_t>(std::max(std::ceil(kLeastPoints * share / (kStep * kStep)), 1.0));
  for (std::size_t i = 0; i < scan_.ranges.size(); ++i) {
    const float range = rangeOf(i, least);
    // Beyond what range_max promises a reading would not be one (REP 117).
    const bool is_reading = range <= static_cast<float>(scan_.range_max);
    const float otherwise = isFree(i) ? std::numeric_limits<float>::infinity() : kNothing;
    scan_.ranges[i] = is_reading ? range : otherwise;
  }
  return scan_;
}

}  // namespace dominant_plane_detection
