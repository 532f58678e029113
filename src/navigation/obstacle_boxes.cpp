#include "navigation/obstacle_boxes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "navigation/ground_frame.h"
#include "navigation/told_height.h"

namespace dominant_plane_detection {
namespace {

constexpr int kStep = 2;  // [px] from one pixel that is looked at to the next
/// Neighbours of one thing differ in depth by less: what a wall has that is seen at 75 degrees, and
/// the sensor's error from pixel to pixel.
constexpr float kJump = 0.05F;          // [m]
constexpr float kJumpOfDepth = 0.015F;  // [-]
/// Or they are as high as each other, on a top that is seen at a low angle.
constexpr float kLevel = 0.01F;          // [m]
constexpr float kLevelOfDepth = 0.004F;  // [-]
constexpr float kApart = 0.25F;          // [m]

constexpr float kLeastArea = 0.0016F;  // [m^2] of a thing, seen from the camera: 4 x 4 cm
constexpr float kFoot = 0.1F;          // [m] what reaches down to here stands on the ground
/// [m] What begins higher is no ground that looks bent: that begins at the ground band, 0.12 m at 4
/// m.
constexpr float kBent = 0.15F;
/// [px] Rows over which steepness is told, [-] what a steep face has of the ground's fall in depth,
/// and the least share of a thing that is steep.
constexpr int kRows = 4;
constexpr float kSteep = 0.5F, kSteepShare = 0.15F;

/// [m] What is longer and wider is more than one thing.
constexpr double kLargeLength = 1.2, kLargeWidth = 0.4;

constexpr float kBin = 0.01F;       // [m] in which extents are told
constexpr float kTrimmed = 0.005F;  // [-] of the readings at each end
constexpr std::ptrdiff_t kSample =
    1000;                        // [#] of readings for that, at least, where there are more
constexpr int kDirections = 18;  // [#] in which a box may lie, 5 degrees apart

constexpr float kNoFloor = -1e9F;

/// Where nearly all of some values are.
struct Extent {
  float low = 0.0F, high = 0.0F;
  float size() const { return high - low; }
  float middle() const { return 0.5F * (low + high); }
};

/// @param bins memory. @param value of a point.
/// @return the values without `kTrimmed` at each end.
template <typename Point, typename Value>
Extent extentOf(const Point* first, const Point* last, std::vector<int>& bins, Value&& value) {
  Extent all{INFINITY, -INFINITY};
  for (const Point* p = first; p != last; ++p) {
    const float v = value(*p);
    all = {std::min(all.low, v), std::max(all.high, v)};
  }
  bins.assign(static_cast<std::size_t>(all.size() / kBin) + 1, 0);
  for (const Point* p = first; p != last; ++p) {
    ++bins[static_cast<std::size_t>((value(*p) - all.low) / kBin)];
  }
  const int trimmed = static_cast<int>(kTrimmed * static_cast<float>(last - first));
  std::size_t low = 0, high = bins.size() - 1;
  for (int left = trimmed - bins[low]; left >= 0 && low < high; left -= bins[++low]) {
  }
  for (int left = trimmed - bins[high]; left >= 0 && high > low; left -= bins[--high]) {
  }
  return {std::max(all.low, all.low + kBin * static_cast<float>(low)),
          std::min(all.high, all.low + kBin * static_cast<float>(high + 1))};
}

/// @return whether what is seen at a pixel and a little below it falls less than the ground would.
bool isSteep(const DepthView& depth, const RayTable& rays, const Eigen::Matrix3f& rotation, int u,
             int v) {
  const int below = std::min(v + kRows, depth.height - 1);
  const float z = metresAt(depth, u, v), z_below = metresAt(depth, u, below);
  if (!(z_below > 0.0F)) return false;
  const float slope = rotation.row(2).dot(rays.ray(u, v));
  const float slope_below = rotation.row(2).dot(rays.ray(u, below));
  if (!(slope_below < 0.0F)) return true;  // above the horizon
  const float level = z * (1.0F - slope / slope_below);
  return z - z_below <= kSteep * level;
}

}  // namespace

const std::vector<UprightBox>& ObstacleBoxes::find(const DepthView& depth, const RayTable& rays,
                                                   const Detection& detection,
                                                   const ObstacleLimits& limits,
                                                   const NoiseModel& local_error) {
  boxes_.clear();
  if (!detection.found()) return boxes_;
  begin(rays, detection);
  collect(depth, rays, detection, limits);
  sortPoints();
  for (std::size_t i = 0; i + 1 < begins_.size(); ++i) {
    Point* const first = sorted_.data() + begins_[i];
    Point* const last = sorted_.data() + begins_[i + 1];
    if (isThing(first, last, local_error)) measure(first, last);
  }
  std::sort(boxes_.begin(), boxes_.end(),
            [](const UprightBox& a, const UprightBox& b) { return a.distance < b.distance; });
  return boxes_;
}

void ObstacleBoxes::begin(const RayTable& rays, const Detection& detection) {
  const Eigen::Isometry3d frame = groundFromOptical(detection.normal, detection.distance);
  rotation_ = frame.linear().cast<float>();
  height_ = static_cast<float>(detection.distance);
  pixel_ = static_cast<float>(kStep * kStep / (rays.camera().fx * rays.camera().fy));
  columns_ = (detection.image_width + kStep - 1) / kStep;
  rows_ = (detection.image_height + kStep - 1) / kStep;
  nodes_.assign(nodeOf(0, rows_), 0);
  floor_.assign(nodes_.size(), kNoFloor);
  points_.clear();
}

/// From the lowest row on, so that it is known what a pixel stands on.
void ObstacleBoxes::collect(const DepthView& depth, const RayTable& rays,
                            const Detection& detection, const ObstacleLimits& limits) {
  const auto low = static_cast<float>(limits.clearance_height);
  const auto high = static_cast<float>(limits.max_obstacle_height);
  for (int row = rows_ - 1; row >= 0; --row) {
    for (int column = 0; column < columns_; ++column) {
      const int u = column * kStep, v = row * kStep;
      const Label label = detection.label(u, v);
      if (label != Label::kObstacle && label != Label::kGround) continue;
      const float z = metresAt(depth, u, v);
      const Eigen::Vector3f ray = rotation_ * rays.ray(u, v);
      const float over = height_ + z * ray.z();
      Point point{z * ray.x(), z * ray.y(), over, z, false, 0};
      point.steep = label == Label::kObstacle && isSteep(depth, rays, rotation_, u, v);
      const bool floor =
          label == Label::kGround || (!point.steep && risesFromFloor(point, column, row));
      if (floor) floor_[nodeOf(column, row)] = over;
      if (floor || !(over >= low && over <= high)) continue;
      point.thing = static_cast<std::uint32_t>(points_.size());
      points_.push_back(point);
      nodes_[nodeOf(column, row)] = point.thing + 1;
      connect(column, row);
    }
  }
}

/// @return whether what is level goes on where the floor, or what rises from it, ends below it.
bool ObstacleBoxes::risesFromFloor(const Point& point, int column, int row) const {
  if (row + 1 == rows_ || point.height > kBent) return false;
  const float most = kLevel + kLevelOfDepth * point.z;
  for (int i = std::max(column - 1, 0); i <= std::min(column + 1, columns_ - 1); ++i) {
    if (std::abs(floor_[nodeOf(i, row + 1)] - point.height) <= most) return true;
  }
  return false;
}

/// With what is left of it and below, also beyond a pixel without a reading.
void ObstacleBoxes::connect(int column, int row) {
  const std::uint32_t point = nodes_[nodeOf(column, row)] - 1;
  for (int i = column - 1; i >= std::max(column - 2, 0); --i) {
    const std::uint32_t other = nodes_[nodeOf(i, row)];
    if (other != 0) {
      link(point, other - 1);
      break;
    }
  }
  for (int i = row + 1; i <= std::min(row + 2, rows_ - 1); ++i) {
    const std::uint32_t other = nodes_[nodeOf(column, i)];
    if (other != 0) return link(point, other - 1);
  }
}

/// Of two points that are one of a thing, the thing is that of the lower number.
void ObstacleBoxes::link(std::uint32_t a, std::uint32_t b) {
  const Point &p = points_[a], &q = points_[b];
  const bool near = std::abs(p.z - q.z) <= kJump + kJumpOfDepth * p.z;
  const bool level = std::abs(p.height - q.height) <= kLevel + kLevelOfDepth * p.z &&
                     std::hypot(p.x - q.x, p.y - q.y) <= kApart;
  if (!near && !level) return;
  const std::uint32_t first = thingOf(a), second = thingOf(b);
  points_[std::max(first, second)].thing = std::min(first, second);
}

std::uint32_t ObstacleBoxes::thingOf(std::uint32_t point) {
  while (points_[point].thing != point) {
    points_[point].thing = points_[points_[point].thing].thing;  // halves the way
    point = points_[point].thing;
  }
  return point;
}

/// The points thing by thing, by counting.
void ObstacleBoxes::sortPoints() {
  std::vector<std::uint32_t>& counts = nodes_;  // is not needed any more
  counts.assign(points_.size() + 1, 0);
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    points_[i].thing = thingOf(i);
    ++counts[points_[i].thing];
  }
  begins_.clear();
  std::uint32_t sum = 0;
  for (std::uint32_t& count : counts) {
    if (count == 0) continue;
    begins_.push_back(sum);
    sum += std::exchange(count, sum);
  }
  begins_.push_back(sum);
  sorted_.resize(points_.size());
  for (const Point& point : points_) sorted_[counts[point.thing]++] = point;
}

/// @return [m^2] as seen from the camera.
float ObstacleBoxes::areaOf(const Point* first, const Point* last) const {
  float area = 0.0F;
  for (const Point* p = first; p != last; ++p) area += pixel_ * p->z * p->z;
  return area;
}

bool ObstacleBoxes::isThing(const Point* first, const Point* last, const NoiseModel& local_error) {
  if (areaOf(first, last) < kLeastArea) return false;
  float steep = 0.0F, nearest = INFINITY;
  for (const Point* p = first; p != last; ++p) {
    steep += p->steep ? 1.0F : 0.0F;
    nearest = std::min(nearest, p->z);
  }
  const Extent heights = extentOf(first, last, bins_, [](const Point& p) { return p.height; });
  if (heights.low >= kBent) return true;
  const double told = toldHeight(local_error, static_cast<double>(nearest));
  return steep >= kSteepShare * static_cast<float>(last - first) &&
         static_cast<double>(heights.high) >= told;
}

/// @return the upright box of least area, of a part of the points where they are many.
UprightBox ObstacleBoxes::boxOf(const Point* first, const Point* last) {
  sample_.clear();
  const std::ptrdiff_t step = std::max<std::ptrdiff_t>((last - first) / kSample, 1);
  for (std::ptrdiff_t i = 0; i < last - first; i += step) sample_.push_back(first[i]);
  first = sample_.data(), last = sample_.data() + sample_.size();
  Extent along, across;
  float least = INFINITY, yaw = 0.0F;
  for (int k = 0; k < kDirections; ++k) {
    const float angle = static_cast<float>(k) * static_cast<float>(0.5 * M_PI / kDirections);
    const float c = std::cos(angle), s = std::sin(angle);
    const Extent a =
        extentOf(first, last, bins_, [c, s](const Point& p) { return c * p.x + s * p.y; });
    const Extent b =
        extentOf(first, last, bins_, [c, s](const Point& p) { return c * p.y - s * p.x; });
    const float size = (a.size() + kBin) * (b.size() + kBin);  // a wall has no width
    if (size >= least) continue;
    least = size, yaw = angle, along = a, across = b;
  }
  UprightBox box;
  box.centre = Eigen::Rotation2Dd(static_cast<double>(yaw)) *
               Eigen::Vector2f(along.middle(), across.middle()).cast<double>();
  box.length = static_cast<double>(std::max(along.size(), across.size()));
  box.width = static_cast<double>(std::min(along.size(), across.size()));
  box.yaw = static_cast<double>(yaw) - (across.size() > along.size() ? 0.5 * M_PI : 0.0);
  return box;
}

/// Walls that meet in a corner would be one box with half the room in it: what is as large is
/// divided until it is not, in the middle of its length.
void ObstacleBoxes::measure(Point* first, Point* last) {
  UprightBox box = boxOf(first, last);
  if (box.length > kLargeLength && box.width > kLargeWidth) {
    const Eigen::Vector2f ahead(static_cast<float>(std::cos(box.yaw)),
                                static_cast<float>(std::sin(box.yaw)));
    const float middle = ahead.dot(box.centre.cast<float>());
    Point* const second = std::partition(
        first, last, [&](const Point& p) { return ahead.x() * p.x + ahead.y() * p.y < middle; });
    for (const auto& [begin, end] : {std::make_pair(first, second), std::make_pair(second, last)}) {
      if (areaOf(begin, end) >= kLeastArea) measure(begin, end);
    }
    return;
  }
  const Extent heights = extentOf(first, last, bins_, [](const Point& p) { return p.height; });
  box.bottom = heights.low < kFoot ? 0.0 : static_cast<double>(heights.low);
  box.top = static_cast<double>(heights.high);
  const Extent ranges =
      extentOf(first, last, bins_, [](const Point& p) { return std::hypot(p.x, p.y); });
  box.distance = static_cast<double>(ranges.low);
  box.pixels = static_cast<std::size_t>(last - first) * kStep * kStep;
  boxes_.push_back(box);
}

}  // namespace dominant_plane_detection
