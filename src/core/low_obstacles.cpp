#include "core/low_obstacles.h"

#include <algorithm>
#include <cmath>

#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {
namespace {

/// [-] Of its height, what a pixel reaches that belongs to an obstacle; and what one at its edge
/// has to stay below to be ground.
constexpr float kOnIt = 0.4F;
constexpr float kOnGround = 0.2F;
constexpr int kEdge = 3;  // [px]
/// [-] Of the fall from pixel to pixel of a vertical face, that of anything steep.
constexpr float kSteep = 0.5F;

constexpr auto kGroundLabel = static_cast<std::uint8_t>(Label::kGround);
constexpr auto kUnknownLabel = static_cast<std::uint8_t>(Label::kUnknown);
constexpr auto kDropOffLabel = static_cast<std::uint8_t>(Label::kDropOff);
constexpr auto kObstacleLabel = static_cast<std::uint8_t>(Label::kObstacle);

constexpr std::uint8_t kNotSeen = 0, kTaken = 1, kRefused = 2, kAtEdge = 3;
/// [px] What one obstacle may have without an allocation: an image of usual size.
constexpr std::size_t kUsualPixels = 640 * 480;

/// [blocks] How far from its evidence an obstacle may grow: 12 pixels, or one larger block.
int growthReach(const GroundLevel& level) { return level.block == kBlockSize ? 3 : 1; }

}  // namespace

void LowObstacles::look(const ImageInput& input, const LabelRule& rule, const BlockHeights& blocks,
                        const LowObstacleLimits& limits, std::vector<std::uint8_t>& kinds) {
  input_ = &input;
  rule_ = rule;
  min_width_ = limits.min_width;
  evidence_.look(input.rays, rule, blocks, limits, kinds);
}

LabelSums LowObstacles::mark(std::vector<std::uint8_t>& labels) {
  lost_ = LabelSums();
  labels_ = &labels;
  pixels_.reserve(std::min(labels.size(), kUsualPixels));
  seen_.reserve(labels.size());
  reach_.reserve(evidence_.ground().levels().front().size());
  for (const GroundLevel& level : evidence_.ground().levels()) search(level);
  return lost_;
}

bool LowObstacles::isInImage(Pixel pixel) const {
  return pixel.u >= 0 && pixel.v >= 0 && pixel.u < input_->depth.width &&
         pixel.v < input_->depth.height;
}

std::size_t LowObstacles::indexOf(Pixel pixel) const {
  return static_cast<std::size_t>(pixel.v) * static_cast<std::size_t>(input_->depth.width) +
         static_cast<std::size_t>(pixel.u);
}

std::uint8_t& LowObstacles::labelOf(Pixel pixel) const { return (*labels_)[indexOf(pixel)]; }

std::optional<LowObstacles::Reading> LowObstacles::read(Pixel pixel) const {
  const float z = metresAt(input_->depth, pixel.u, pixel.v);
  if (!(z >= input_->range.min && z <= input_->range.max)) return std::nullopt;
  const Eigen::Vector3f ray = input_->rays.ray(pixel.u, pixel.v);
  const float along = rule_.normal[0] * ray.x() + rule_.normal[1] * ray.y() + rule_.normal[2];
  return Reading{pixel, z, z * along + rule_.distance};
}

bool LowObstacles::isOnGround(const Reading& reading, float ground) const {
  return !(reading.height - std::min(ground, 0.0F) > kOnPlane * rule_.narrowBand(reading.z));
}

void LowObstacles::change(Pixel pixel, float height, std::uint8_t label) {
  std::uint8_t& now = labelOf(pixel);
  if (now == kGroundLabel) {
    ++lost_.ground;
    lost_.square_height += static_cast<double>(height) * static_cast<double>(height);
  }
  now = label;
}

void LowObstacles::search(const GroundLevel& level) {
  evidence_.find(level, blocks_);
  if (blocks_.empty()) return;
  seen_.assign(labels_->size(), kNotSeen);
  spreadReach(level);
  for (const Evidence& block : blocks_) {
    const int left = block.x * level.block, top = block.y * level.block;
    for (int v = top; v < std::min(top + level.block, input_->depth.height); ++v) {
      for (int u = left; u < std::min(left + level.block, input_->depth.width); ++u) {
        pixels_.clear();
        // What is an obstacle already is evidence of itself: not grown again, for time.
        if (labelOf({u, v}) == kObstacleLabel || !join(level, {u, v})) continue;
        grow(level);
        if (isWide()) write(level);
      }
    }
  }
}

void LowObstacles::spreadReach(const GroundLevel& level) {
  const int reach = growthReach(level);
  reach_.assign(level.size(), 0.0F);
  for (const Evidence& block : blocks_) {
    const int bottom = std::min(block.y + reach, level.rows - 1);
    const int right = std::min(block.x + reach, level.columns - 1);
    for (int y = std::max(block.y - reach, 0); y <= bottom; ++y) {
      for (int x = std::max(block.x - reach, 0); x <= right; ++x) {
        float& highest = reach_[level.at(x, y)];
        highest = std::max(highest, block.height);
      }
    }
  }
}

float LowObstacles::reachOf(const GroundLevel& level, Pixel pixel) const {
  return reach_[level.at(pixel.u / level.block, pixel.v / level.block)];
}

void LowObstacles::grow(const GroundLevel& level) {
  for (std::size_t next = 0; next < pixels_.size(); ++next) {
    const Reading reading = pixels_[next];  // not a reference: they grow
    const Pixel pixel = reading.pixel;
    for (int v = pixel.v - 1; v <= pixel.v + 1; ++v) {
      for (int u = pixel.u - 1; u <= pixel.u + 1; ++u) {
        if (isInImage({u, v}) && !join(level, {u, v})) joinFace(level, reading, {u, v});
      }
    }
  }
}

/// Looks at a pixel once: it joins if it is high enough to belong to the evidence about it.
bool LowObstacles::join(const GroundLevel& level, Pixel pixel) {
  std::uint8_t& seen = seen_[indexOf(pixel)];
  if (seen == kTaken || seen == kRefused || labelOf(pixel) == kDropOffLabel) return false;
  const float reach = reachOf(level, pixel);
  if (reach == 0.0F) return false;
  seen = kRefused;
  const std::optional<Reading> reading = read(pixel);
  if (!reading) return false;
  const float ground = level.groundAt(pixel.u, pixel.v);
  if (isOnGround(*reading, ground) || reading->height - ground <= kOnIt * reach) return false;
  seen = kTaken;
  pixels_.push_back(*reading);
  return true;
}

/// @param above a pixel of the obstacle, next to a pixel that does not belong to it by its height.
bool LowObstacles::joinFace(const GroundLevel& level, const Reading& above, Pixel pixel) {
  std::uint8_t& seen = seen_[indexOf(pixel)];
  if (seen != kRefused) return false;
  const std::optional<Reading> reading = read(pixel);
  if (!reading || reading->height >= above.height) return false;
  const float over = reading->height - level.groundAt(pixel.u, pixel.v);
  if (!isFace(above, *reading, over)) return false;
  seen = kTaken;
  pixels_.push_back(*reading);
  return true;
}

/// A vertical face through a point, turned towards the camera, goes on where other rays have the
/// same distance from the camera along the floor. Its lowest pixels are no lower than half a pixel.
/// @param over [m] height of the pixel below over the ground about it.
bool LowObstacles::isFace(const Reading& above, const Reading& below, float over) const {
  const Eigen::Vector3f up(rule_.normal[0], rule_.normal[1], rule_.normal[2]);
  const Eigen::Vector3f ray = input_->rays.ray(above.pixel.u, above.pixel.v);
  const Eigen::Vector3f ray_below = input_->rays.ray(below.pixel.u, below.pixel.v);
  const Eigen::Vector3f ahead = ray - up.dot(ray) * up;
  const float face_z = above.z * ahead.dot(ray) / ahead.dot(ray_below);
  const float face_fall = above.z * up.dot(ray) - face_z * up.dot(ray_below);
  const CameraModel& camera = input_->rays.camera();
  const float pixel = above.z / static_cast<float>(std::max(camera.fx, camera.fy));
  return face_fall > kSteep * pixel && above.height - below.height >= kSteep * face_fall &&
         over > kSteep * face_fall;
}

bool LowObstacles::isWide() const {
  PixelOutline outline(pixels_.front().pixel);
  for (const Reading& each : pixels_) outline.add(each.pixel);
  const auto z = static_cast<double>(pixels_[pixels_.size() / 2].z);
  return outline.width(z, input_->rays.camera()) >= min_width_;
}

/// @return whether the four pixels about one are of a candidate as well.
bool LowObstacles::isInside(Pixel pixel) const {
  const auto taken = [&](Pixel p) { return isInImage(p) && seen_[indexOf(p)] == kTaken; };
  return taken({pixel.u - 1, pixel.v}) && taken({pixel.u + 1, pixel.v}) &&
         taken({pixel.u, pixel.v - 1}) && taken({pixel.u, pixel.v + 1});
}

/// Labels the candidate, and its edge.
void LowObstacles::write(const GroundLevel& level) {
  for (const Reading& each : pixels_) change(each.pixel, each.height, kObstacleLabel);
  for (const Reading& each : pixels_) {
    if (!isInside(each.pixel)) writeEdge(level, each.pixel);
  }
}

void LowObstacles::writeEdge(const GroundLevel& level, Pixel pixel) {
  const float floor = kOnGround * reachOf(level, pixel);
  const int last_u = std::min(pixel.u + kEdge, input_->depth.width - 1);
  const int last_v = std::min(pixel.v + kEdge, input_->depth.height - 1);
  for (int v = std::max(pixel.v - kEdge, 0); v <= last_v; ++v) {
    for (int u = std::max(pixel.u - kEdge, 0); u <= last_u; ++u) {
      // Once a pixel: the edge of a ragged candidate is long.
      std::uint8_t& seen = seen_[indexOf({u, v})];
      if (seen == kAtEdge || labelOf({u, v}) != kGroundLabel) continue;
      seen = kAtEdge;
      const std::optional<Reading> reading = read({u, v});
      if (!reading) continue;
      const float ground = level.groundAt(u, v);
      if (isOnGround(*reading, ground) || reading->height - ground <= floor) continue;
      change({u, v}, reading->height, kUnknownLabel);
    }
  }
}

}  // namespace dominant_plane_detection
