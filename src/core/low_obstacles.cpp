#include "core/low_obstacles.h"

#include <algorithm>
#include <cmath>

#include "core/tile_moments.h"
#include "core/tile_neighbours.h"
#include "core/widen_tiles.h"
#include "dominant_plane_detection/detection.h"

namespace dominant_plane_detection {
namespace {

/// [-] Of its height, what a pixel reaches that belongs to an obstacle; and what one at its edge
/// has to stay below to be ground.
constexpr float kOnIt = 0.4F;
constexpr float kOnGround = 0.2F;
constexpr int kEdge = 3;  // [px]
/// [-] Of the narrow band: the mean of tiles that are the foot of what they hang together with.
constexpr float kFoot = 2.0F;
/// [-] Share of a window that has to be ground, for evidence of something that stands on it.
constexpr float kMinSupport = 0.4F;
/// [-] Windows are at least this much wider than the narrowest obstacle: it must not fill them.
constexpr double kWindowWidths = 1.5;

constexpr int kTileBlocks = kTileSize / kBlockSize;
constexpr int kHalf = kTileBlocks * kTileBlocks / 2;  // [blocks] of a tile

constexpr auto kGroundLabel = static_cast<std::uint8_t>(Label::kGround);
constexpr auto kUnknownLabel = static_cast<std::uint8_t>(Label::kUnknown);
constexpr auto kObstacleLabel = static_cast<std::uint8_t>(Label::kObstacle);

constexpr std::uint8_t kNotSeen = 0, kTaken = 1, kRefused = 2, kAtEdge = 3;
/// [px] What one obstacle may have without an allocation: an image of usual size.
constexpr std::size_t kUsualPixels = 640 * 480;

/// [blocks] How far from its evidence an obstacle may grow: 12 pixels, or one larger block.
int growthReach(const GroundLevel& level) { return level.block == kBlockSize ? 3 : 1; }

}  // namespace

double LowObstacles::evidence(std::size_t blocks, double false_alarm_rate) {
  const double share = std::min(false_alarm_rate / static_cast<double>(blocks), 0.5);
  double low = 0.0, high = 40.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > share ? low : high) = middle;
  }
  return high;
}

std::size_t LowObstacles::indexOf(Pixel pixel) const {
  return static_cast<std::size_t>(pixel.v) * static_cast<std::size_t>(input_->depth.width) +
         static_cast<std::size_t>(pixel.u);
}

/// @return [m] the height over the plane of a pixel that may stand on it; nothing without a reading
/// in the working range, or on the plane.
std::optional<float> LowObstacles::heightOff(Pixel pixel) const {
  const float z = metresAt(input_->depth, pixel.u, pixel.v);
  if (!(z >= input_->range.min && z <= input_->range.max)) return std::nullopt;
  const Eigen::Vector3f ray = input_->rays.ray(pixel.u, pixel.v);
  const float along = rule_.normal[0] * ray.x() + rule_.normal[1] * ray.y() + rule_.normal[2];
  const float height = z * along + rule_.distance;
  if (!(height > kOnPlane * (rule_.narrow + rule_.narrow_z2 * z * z))) return std::nullopt;
  return height;
}

void LowObstacles::change(Pixel pixel, float height, std::uint8_t label,
                          std::vector<std::uint8_t>& labels) {
  std::uint8_t& now = labels[indexOf(pixel)];
  if (now == kGroundLabel) {
    ++loss_.pixels;
    loss_.square_height += static_cast<double>(height) * static_cast<double>(height);
  }
  now = label;
}

void LowObstacles::look(const ImageInput& input, const LabelRule& rule,
                        const LowObstacleLimits& limits, std::vector<std::uint8_t>& tiles) {
  input_ = &input;
  rule_ = rule;
  limits_ = limits;
  computeBlockHeights(input, rule, blocks_);
  local_ground_.fit(blocks_, tiles, input.rays, rule, limits.local_error,
                    kWindowWidths * limits.min_width);
  widen(blocks_.off, unsure_);
  widen(blocks_.beyond, near_beyond_);
  spreadFeet(tiles);
}

/// The foot of what is beyond the band: tiles next to it, and tiles off the plane that hang
/// together with these.
void LowObstacles::spreadFeet(std::vector<std::uint8_t>& tiles) {
  const GroundLevel& level = local_ground_.tiles();
  feet_.clear();
  const auto take = [&](std::size_t tile) {
    if (tiles[tile] != kNearGround) return;
    tiles[tile] = kSmeared;
    feet_.push_back(tile);
  };
  for (std::size_t tile = 0; tile < near_beyond_.size(); ++tile) {
    if (near_beyond_[tile]) take(tile);
  }
  for (std::size_t next = 0; next < feet_.size(); ++next) {
    forEachNeighbour(feet_[next], level.columns, level.rows, [&](std::size_t tile) {
      const float z = level.depth[tile];
      const float narrow = rule_.narrow + rule_.narrow_z2 * z * z;
      if (std::abs(level.mean[tile]) > kFoot * narrow) take(tile);
    });
  }
}

GroundLoss LowObstacles::mark(std::vector<std::uint8_t>& labels) {
  loss_ = GroundLoss();
  pixels_.reserve(std::min(labels.size(), kUsualPixels));
  evidence_blocks_.reserve(blocks_.size());
  reach_.reserve(blocks_.size());
  seen_.reserve(labels.size());
  std::size_t all = 0;
  for (const GroundLevel& level : local_ground_.levels()) all += level.size();
  evidence_ = static_cast<float>(evidence(all, limits_.false_alarm_rate));
  for (const GroundLevel& level : local_ground_.levels()) search(level, labels);
  return loss_;
}

/// Widens the tiles of which at least half of the blocks are marked.
void LowObstacles::widen(const std::vector<std::uint8_t>& marked, std::vector<std::uint8_t>& wide) {
  const GroundLevel& tiles = local_ground_.tiles();
  marked_tiles_.assign(tiles.size(), 0);
  for (int y = 0; y < blocks_.rows; ++y) {
    const std::uint8_t* from = marked.data() + static_cast<std::ptrdiff_t>(y) * blocks_.columns;
    std::uint8_t* tile = marked_tiles_.data() + tiles.at(0, y / kTileBlocks);
    for (int x = 0; x < blocks_.columns; ++x) tile[x / kTileBlocks] += from[x];
  }
  for (std::uint8_t& tile : marked_tiles_) tile = tile >= kHalf;
  widenTiles(tiles.columns, tiles.rows, marked_tiles_, in_row_, wide);
}

/// @return whether more than a quarter of a block's tiles are next to what is tall, or to nothing.
bool LowObstacles::isUnsure(const GroundLevel& level, int x, int y) const {
  const GroundLevel& tiles = local_ground_.tiles();
  const int side = std::max(level.block / kTileSize, 1);
  const int left = x * level.block / kTileSize, top = y * level.block / kTileSize;
  int unsure = 0;
  for (int j = top; j < std::min(top + side, tiles.rows); ++j) {
    for (int i = left; i < std::min(left + side, tiles.columns); ++i) {
      unsure += unsure_[tiles.at(i, j)];
    }
  }
  return 4 * unsure > side * side;
}

bool LowObstacles::isEvidence(const GroundLevel& level, int x, int y) const {
  const std::size_t at = level.at(x, y);
  const float z = level.depth[at];
  const float over = level.mean[at] - level.ground[at];
  const float limit = evidence_ * (static_cast<float>(limits_.local_error.constant) +
                                   static_cast<float>(limits_.local_error.quadratic) * z * z);
  return over >= limit && z >= level.min_depth && level.support[at] >= kMinSupport &&
         over >= static_cast<float>(limits_.min_height) && level.isRead(at) &&
         !isUnsure(level, x, y);
}

void LowObstacles::search(const GroundLevel& level, std::vector<std::uint8_t>& labels) {
  const int reach = growthReach(level);
  evidence_blocks_.clear();
  for (int y = level.first_row; y < level.end_row; ++y) {
    for (int x = 0; x < level.columns; ++x) {
      if (isEvidence(level, x, y)) evidence_blocks_.push_back({x, y});
    }
  }
  if (evidence_blocks_.empty()) return;
  reach_.assign(level.size(), 0.0F);
  seen_.assign(labels.size(), kNotSeen);
  for (const Pixel& block : evidence_blocks_) {
    const std::size_t at = level.at(block.u, block.v);
    const float over = level.mean[at] - level.ground[at];
    const int bottom = std::min(block.v + reach, level.rows - 1);
    const int right = std::min(block.u + reach, level.columns - 1);
    for (int y = std::max(block.v - reach, 0); y <= bottom; ++y) {
      for (int x = std::max(block.u - reach, 0); x <= right; ++x) {
        float& highest = reach_[level.at(x, y)];
        highest = std::max(highest, over);
      }
    }
  }
  for (const Pixel& block : evidence_blocks_) {
    const int left = block.u * level.block, top = block.v * level.block;
    for (int v = top; v < std::min(top + level.block, input_->depth.height); ++v) {
      for (int u = left; u < std::min(left + level.block, input_->depth.width); ++u) {
        if (joins(level, {u, v})) grow(level, {u, v}, labels);
      }
    }
  }
}

float LowObstacles::reachOf(const GroundLevel& level, Pixel pixel) const {
  return reach_[level.at(pixel.u / level.block, pixel.v / level.block)];
}

/// Looks at a pixel once.
/// @return whether it is high enough to belong to the evidence about it.
bool LowObstacles::joins(const GroundLevel& level, Pixel pixel) {
  if (pixel.u < 0 || pixel.v < 0 || pixel.u >= input_->depth.width ||
      pixel.v >= input_->depth.height) {
    return false;
  }
  std::uint8_t& seen = seen_[indexOf(pixel)];
  if (seen == kTaken || seen == kRefused) return false;
  const float reach = reachOf(level, pixel);
  if (reach == 0.0F) return false;
  const std::optional<float> height = heightOff(pixel);
  const bool on_it = height && *height - level.groundAt(pixel.u, pixel.v) > kOnIt * reach;
  seen = on_it ? kTaken : kRefused;
  return on_it;
}

void LowObstacles::grow(const GroundLevel& level, Pixel start, std::vector<std::uint8_t>& labels) {
  pixels_.clear();
  pixels_.push_back(start);
  Outline outline{start.u, start.u, start.v, start.v};
  for (std::size_t next = 0; next < pixels_.size(); ++next) {
    const Pixel pixel = pixels_[next];
    outline = {std::min(outline.left, pixel.u), std::max(outline.right, pixel.u),
               std::min(outline.top, pixel.v), std::max(outline.bottom, pixel.v)};
    for (int v = pixel.v - 1; v <= pixel.v + 1; ++v) {
      for (int u = pixel.u - 1; u <= pixel.u + 1; ++u) {
        if (joins(level, {u, v})) pixels_.push_back({u, v});
      }
    }
  }
  const int side = std::max(outline.right - outline.left, outline.bottom - outline.top) + 1;
  const Pixel middle = pixels_[pixels_.size() / 2];
  const float z = metresAt(input_->depth, middle.u, middle.v);
  const CameraModel& camera = input_->rays.camera();
  const double width = side * static_cast<double>(z) / std::max(camera.fx, camera.fy);
  if (width >= limits_.min_width) write(level, labels);
}

/// @return whether the four pixels about one are of a candidate as well.
bool LowObstacles::isInside(Pixel pixel) const {
  const auto taken = [&](int u, int v) {
    return u >= 0 && v >= 0 && u < input_->depth.width && v < input_->depth.height &&
           seen_[indexOf({u, v})] == kTaken;
  };
  return taken(pixel.u - 1, pixel.v) && taken(pixel.u + 1, pixel.v) &&
         taken(pixel.u, pixel.v - 1) && taken(pixel.u, pixel.v + 1);
}

/// Labels the candidate, and its edge.
void LowObstacles::write(const GroundLevel& level, std::vector<std::uint8_t>& labels) {
  for (const Pixel& pixel : pixels_) {
    change(pixel, heightOff(pixel).value_or(0.0F), kObstacleLabel, labels);
  }
  for (const Pixel& pixel : pixels_) {
    if (isInside(pixel)) continue;
    const float floor = kOnGround * reachOf(level, pixel);
    const int last_u = std::min(pixel.u + kEdge, input_->depth.width - 1);
    const int last_v = std::min(pixel.v + kEdge, input_->depth.height - 1);
    for (int v = std::max(pixel.v - kEdge, 0); v <= last_v; ++v) {
      for (int u = std::max(pixel.u - kEdge, 0); u <= last_u; ++u) {
        // Once a pixel: the edge of a ragged candidate is long.
        std::uint8_t& seen = seen_[indexOf({u, v})];
        if (seen == kAtEdge || labels[indexOf({u, v})] != kGroundLabel) continue;
        seen = kAtEdge;
        const std::optional<float> height = heightOff({u, v});
        if (!height || *height - level.groundAt(u, v) <= floor) continue;
        change({u, v}, *height, kUnknownLabel, labels);
      }
    }
  }
}

}  // namespace dominant_plane_detection
