#include "navigation/connected_obstacles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "navigation/ground_frame.h"

namespace dominant_plane_detection {
namespace {

/// Neighbours of one thing differ in depth by less: what a wall has that is seen at 75 degrees, and
/// the sensor's error from pixel to pixel.
constexpr float kJump = 0.05F;          // [m]
constexpr float kJumpOfDepth = 0.015F;  // [-]
/// Or they are as high as each other, on a top that is seen at a low angle.
constexpr float kLevel = 0.01F;          // [m]
constexpr float kLevelOfDepth = 0.004F;  // [-]
constexpr float kApart = 0.25F;          // [m]
/// [px] over which steepness is told, and [-] what a steep face has of the ground's fall in depth.
constexpr int kOver = 4;
constexpr float kSteep = 0.5F;
constexpr float kBent = 0.3F;       // [m] no floor is bent up higher
constexpr double kLooksDown = 0.2;  // [rad] from straight down
constexpr float kNoFloor = -1e9F;

/// @return the direction along rows or columns that points to the ground.
Eigen::Vector2i downOf(const Eigen::Vector3d& normal) {
  if (normal.head<2>().norm() < std::sin(kLooksDown)) return Eigen::Vector2i::Zero();
  if (std::abs(normal.x()) > std::abs(normal.y())) return {normal.x() < 0.0 ? 1 : -1, 0};
  return {0, normal.y() < 0.0 ? 1 : -1};
}

}  // namespace

void ConnectedObstacles::find(const DepthView& depth, const RayTable& rays,
                              const Detection& detection, const ObstacleLimits& limits) {
  const Image image{depth, rays, detection};
  setView(image);
  collect(image, limits);
  sortPoints();
}

void ConnectedObstacles::setView(const Image& image) {
  const Detection& detection = image.detection;
  rotation_ = groundFromOptical(detection.normal, detection.distance).linear().cast<float>();
  height_ = static_cast<float>(detection.distance);
  const CameraModel& camera = image.rays.camera();
  pixel_area_ = static_cast<float>(kStep * kStep / (camera.fx * camera.fy));
  down_ = downOf(detection.normal);
  const int columns = (detection.image_width + kStep - 1) / kStep;
  const int rows = (detection.image_height + kStep - 1) / kStep;
  const bool sideways = down_.x() != 0;
  width_ = sideways ? rows : columns;
  lines_ = sideways ? columns : rows;
  nodes_.assign(nodeOf(0, lines_), 0);
  floor_.assign(nodes_.size(), kNoFloor);
  points_.clear();
}

Eigen::Vector2i ConnectedObstacles::pixelOf(int across, int line) const {
  const int from_end = lines_ - 1 - line;
  if (down_.x() != 0) return kStep * Eigen::Vector2i(down_.x() > 0 ? from_end : line, across);
  return kStep * Eigen::Vector2i(across, down_.y() >= 0 ? from_end : line);
}

/// From the lowest line on, so that it is known what a pixel stands on.
void ConnectedObstacles::collect(const Image& image, const ObstacleLimits& limits) {
  const auto low = static_cast<float>(limits.clearance_height);
  const auto high = static_cast<float>(limits.max_obstacle_height);
  for (int line = 0; line < lines_; ++line) {
    for (int across = 0; across < width_; ++across) {
      const Eigen::Vector2i pixel = pixelOf(across, line);
      const Label label = image.detection.label(pixel.x(), pixel.y());
      if (label != Label::kObstacle && label != Label::kGround) continue;
      const float z = metresAt(image.depth, pixel.x(), pixel.y());
      const Eigen::Vector3f ray = image.rays.ray(pixel.x(), pixel.y());
      if (label == Label::kGround) {
        floor_[nodeOf(across, line)] = height_ + z * rotation_.row(2).dot(ray);
        continue;
      }
      const Eigen::Vector3f at = z * (rotation_ * ray);
      ObstaclePoint point{at.x(), at.y(), height_ + at.z(), z, isSteep(image, pixel), 0};
      const bool floor = !point.steep && risesFromFloor(point, across, line);
      if (floor) floor_[nodeOf(across, line)] = point.height;
      if (floor || !(point.height >= low && point.height <= high)) continue;
      point.thing = static_cast<std::uint32_t>(points_.size());
      points_.push_back(point);
      nodes_[nodeOf(across, line)] = point.thing + 1;
      connect(across, line);
    }
  }
}

/// @return whether what is seen at a pixel and a little below it falls less than the ground would.
bool ConnectedObstacles::isSteep(const Image& image, const Eigen::Vector2i& pixel) const {
  if (looksDown()) return false;
  const Eigen::Vector2i last(image.depth.width - 1, image.depth.height - 1);
  const Eigen::Vector2i below =
      (pixel + kOver * down_).cwiseMax(Eigen::Vector2i::Zero()).cwiseMin(last);
  const float z = metresAt(image.depth, pixel.x(), pixel.y());
  const float z_below = metresAt(image.depth, below.x(), below.y());
  if (!(z_below > 0.0F && std::isfinite(z_below))) return false;
  const float slope = rotation_.row(2).dot(image.rays.ray(pixel.x(), pixel.y()));
  const float slope_below = rotation_.row(2).dot(image.rays.ray(below.x(), below.y()));
  if (!(slope_below < 0.0F)) return true;  // above the horizon
  const float level = z * (1.0F - slope / slope_below);
  return z - z_below <= kSteep * level;
}

/// @return whether what is level goes on where the floor, or what rises from it, ends below it.
bool ConnectedObstacles::risesFromFloor(const ObstaclePoint& point, int across, int line) const {
  if (line == 0 || point.height > kBent) return false;
  const float most = kLevel + kLevelOfDepth * point.z;
  for (int i = std::max(across - 1, 0); i <= std::min(across + 1, width_ - 1); ++i) {
    if (std::abs(floor_[nodeOf(i, line - 1)] - point.height) <= most) return true;
  }
  return false;
}

/// With what is beside it and below, also beyond a pixel without a reading.
void ConnectedObstacles::connect(int across, int line) {
  const std::uint32_t point = nodes_[nodeOf(across, line)] - 1;
  for (int i = across - 1; i >= std::max(across - 2, 0); --i) {
    const std::uint32_t other = nodes_[nodeOf(i, line)];
    if (other == 0) continue;
    link(point, other - 1);
    break;
  }
  for (int i = line - 1; i >= std::max(line - 2, 0); --i) {
    const std::uint32_t other = nodes_[nodeOf(across, i)];
    if (other != 0) return link(point, other - 1);
  }
}

/// Of two points that are one of a thing, the thing is that of the lower number.
void ConnectedObstacles::link(std::uint32_t a, std::uint32_t b) {
  const ObstaclePoint &p = points_[a], &q = points_[b];
  const bool near = std::abs(p.z - q.z) <= kJump + kJumpOfDepth * p.z;
  const auto level = [&] {
    const float dx = p.x - q.x, dy = p.y - q.y;
    return std::abs(p.height - q.height) <= kLevel + kLevelOfDepth * p.z &&
           dx * dx + dy * dy <= kApart * kApart;
  };
  if (!near && !level()) return;
  const std::uint32_t first = thingOf(a), second = thingOf(b);
  points_[std::max(first, second)].thing = std::min(first, second);
}

std::uint32_t ConnectedObstacles::thingOf(std::uint32_t point) {
  while (points_[point].thing != point) {
    points_[point].thing = points_[points_[point].thing].thing;  // halves the way
    point = points_[point].thing;
  }
  return point;
}

/// Thing by thing, by counting.
void ConnectedObstacles::sortPoints() {
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
  for (const ObstaclePoint& point : points_) sorted_[counts[point.thing]++] = point;
}

}  // namespace dominant_plane_detection
