#include "core/local_ground.h"

#include <algorithm>
#include <cmath>

#include "core/tile_moments.h"

namespace dominant_plane_detection {
namespace {

constexpr float kWindow = (2 * kGroundReach + 1) * (2 * kGroundReach + 1);
constexpr float kClip = 2.5F;       // [-] in local errors
constexpr float kFirstClip = 4.0F;  // [-] of the first look, against the plane itself
/// [-] Share of a window that tells a height; with less, that of the level before stays.
constexpr float kMinSupport = 0.25F;

/// [blocks] How far beyond the rows that are searched an obstacle's growth looks at the ground.
constexpr int kBeyond = 4;

/// The rows that the windows of these look at.
Rows readRows(const GroundLevel& level) {
  const Rows kept = keptRows(level);
  return {std::max(kept.first - kGroundReach, 0), std::min(kept.end + kGroundReach, level.rows)};
}

/// The plane's depth in the middle of each block; 0 above its horizon.
void findDepths(const RayTable& rays, const LabelRule& plane, GroundLevel& level) {
  level.depth.resize(level.size());
  level.first_row = level.rows;
  level.end_row = 0;
  for (int y = 0; y < level.rows; ++y) {
    const int v = std::min(y * level.block + level.block / 2, rays.camera().height - 1);
    const float* ray_x = rays.x(v);
    const float* ray_y = rays.y(v);
    const auto alongAt = [&](int x) {
      const int u = std::min(x * level.block + level.block / 2, rays.camera().width - 1);
      return plane.normal[0] * ray_x[u] + plane.normal[1] * ray_y[rays.separable() ? 0 : u] +
             plane.normal[2];
    };
    float* depth = level.depth.data() + level.at(0, y);
    float farthest = 0.0F;
    for (int x = 0; x < level.columns; ++x) {
      const float along = alongAt(x);
      depth[x] = along < 0.0F ? -plane.distance / along : 0.0F;
      farthest = std::max(farthest, depth[x]);
    }
    if (farthest < level.min_depth) continue;
    level.first_row = std::min(level.first_row, y);
    level.end_row = y + 1;
  }
  level.first_row = std::min(level.first_row, level.end_row);
}

/// Sums of two by two blocks.
void halve(const std::vector<float>& from, int from_columns, int from_rows, int columns, int rows,
           std::vector<float>& to) {
  to.assign(static_cast<std::size_t>(columns * rows), 0.0F);
  for (int y = 0; y < from_rows; ++y) {
    const float* in = from.data() + static_cast<std::ptrdiff_t>(y) * from_columns;
    float* out = to.data() + static_cast<std::ptrdiff_t>(y / 2) * columns;
    for (int x = 0; x + 1 < from_columns; x += 2) out[x / 2] += in[x] + in[x + 1];
    if (from_columns % 2 != 0) out[columns - 1] += in[from_columns - 1];
  }
}

}  // namespace

Rows keptRows(const GroundLevel& level) {
  return {std::max(level.first_row - kBeyond, 0), std::min(level.end_row + kBeyond, level.rows)};
}

float GroundLevel::groundAt(int u, int v) const {
  // In units of blocks, 0 in the middle of the first one.
  const auto place = [&](int pixel, int blocks) {
    const float middle = (static_cast<float>(pixel) + 0.5F) / static_cast<float>(block) - 0.5F;
    return std::clamp(middle, 0.0F, static_cast<float>(blocks - 1));
  };
  const float x = place(u, columns), y = place(v, rows);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, columns - 1), bottom = std::min(top + 1, rows - 1);
  const float a = x - static_cast<float>(left), b = y - static_cast<float>(top);
  return (1.0F - b) * ((1.0F - a) * ground[at(left, top)] + a * ground[at(right, top)]) +
         b * ((1.0F - a) * ground[at(left, bottom)] + a * ground[at(right, bottom)]);
}

void LocalGround::collect(const BlockHeights& blocks) {
  GroundLevel& finest = levels_.front();
  finest.columns = blocks.columns;
  finest.rows = blocks.rows;
  finest.count = blocks.count;
  finest.mean = blocks.sum;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    GroundLevel& level = levels_[i];
    level.block = kBlockSize << i;
    if (i == 0) continue;
    const GroundLevel& finer = levels_[i - 1];
    level.columns = (finer.columns + 1) / 2;
    level.rows = (finer.rows + 1) / 2;
    halve(finer.count, finer.columns, finer.rows, level.columns, level.rows, level.count);
    halve(finer.mean, finer.columns, finer.rows, level.columns, level.rows, level.mean);
  }
}

/// Turns sums into means, and finds out which blocks are ground.
/// @param kinds of tiles; a block of the coarsest level is ground if all of its tiles are.
void LocalGround::average(const std::vector<std::uint8_t>& kinds, GroundLevel& level) {
  const int tile_columns = tiles().columns, tile_rows = tiles().rows;
  level.can_support.resize(level.size());
  const Rows kept = readRows(level);
  for (int y = kept.first; y < kept.end; ++y) {
    const int top = y * level.block / kTileSize;
    const int bottom = std::min(((y + 1) * level.block - 1) / kTileSize, tile_rows - 1);
    const std::uint8_t* upper = kinds.data() + static_cast<std::ptrdiff_t>(top) * tile_columns;
    const std::uint8_t* lower = kinds.data() + static_cast<std::ptrdiff_t>(bottom) * tile_columns;
    for (int x = 0; x < level.columns; ++x) {
      const std::size_t at = level.at(x, y);
      const int left = x * level.block / kTileSize;
      const int right = std::min(((x + 1) * level.block - 1) / kTileSize, tile_columns - 1);
      const bool ground = upper[left] == kNearGround && upper[right] == kNearGround &&
                          lower[left] == kNearGround && lower[right] == kNearGround;
      const bool is_read = level.isRead(at);
      level.mean[at] = is_read ? level.mean[at] / level.count[at] : 0.0F;
      level.can_support[at] = ground && is_read ? 1.0F : 0.0F;
    }
  }
}

void LocalGround::smooth(GroundLevel& level, const NoiseModel& local_error, float clip) {
  const auto constant = static_cast<float>(local_error.constant);
  const auto quadratic = static_cast<float>(local_error.quadratic);
  weight_.resize(level.size());
  weighted_.resize(level.size());
  const Rows kept = keptRows(level), read = readRows(level);
  const std::size_t end = level.at(0, read.end);
  // Plain pointers: the compiler cannot know that the vectors do not overlap.
  const float* const depth = level.depth.data();
  const float* const mean = level.mean.data();
  const float* const support = level.can_support.data();
  const float* const ground = level.ground.data();
  // A value is read before it is chosen: then there is no jump, and the loops become vectors.
  float* const weight = weight_.data();
  float* const weighted = weighted_.data();
#pragma GCC ivdep
  for (std::size_t at = level.at(0, read.first); at < end; ++at) {
    const float limit = clip * (constant + quadratic * depth[at] * depth[at]);
    const float has_a_say = support[at];
    const float counts = std::abs(mean[at] - ground[at]) < limit ? has_a_say : 0.0F;
    weight[at] = counts;
    weighted[at] = counts * mean[at];
  }
  window_weight_.resize(level.size());
  window_sum_.resize(level.size());
  sumWindows<kGroundReach>(weight, level.columns, level.rows, kept, column_sum_,
                           window_weight_.data());
  sumWindows<kGroundReach>(weighted, level.columns, level.rows, kept, column_sum_,
                           window_sum_.data());
  level.support.resize(level.size());
  const float* const window_weight = window_weight_.data();
  const float* const window_sum = window_sum_.data();
  float* const share = level.support.data();
  float* const new_ground = level.ground.data();
  const std::size_t last = level.at(0, kept.end);
#pragma GCC ivdep
  for (std::size_t at = level.at(0, kept.first); at < last; ++at) {
    const float blocks = window_weight[at];
    const float before = new_ground[at];
    const float local = window_sum[at] / (blocks < 1.0F ? 1.0F : blocks);
    share[at] = blocks / kWindow;
    new_ground[at] = blocks < kMinSupport * kWindow ? before : local;
  }
}

/// The level before is what its ground is looked for about, between its blocks linear: along a row
/// and along a column, a block's centre is a quarter from the one and three from the other.
void LocalGround::start(const GroundLevel* coarser, GroundLevel& level) {
  level.ground.resize(level.size());
  if (coarser == nullptr) {
    std::fill(level.ground.begin(), level.ground.end(), 0.0F);
    return;
  }
  const Rows read = readRows(level);
  for (int y = read.first; y < read.end; ++y) {
    const int near = y / 2;
    const int other = std::clamp(y % 2 ? near + 1 : near - 1, 0, coarser->rows - 1);
    const float* a = coarser->ground.data() + coarser->at(0, near);
    const float* b = coarser->ground.data() + coarser->at(0, other);
    column_sum_.resize(static_cast<std::size_t>(coarser->columns) + 2);
    float* between = column_sum_.data() + 1;
    for (int x = 0; x < coarser->columns; ++x) between[x] = 0.75F * a[x] + 0.25F * b[x];
    between[-1] = between[0];
    between[coarser->columns] = between[coarser->columns - 1];
    float* to = level.ground.data() + level.at(0, y);
    for (int x = 0; x < level.columns; ++x) {
      to[x] = 0.75F * between[x / 2] + 0.25F * between[x % 2 ? x / 2 + 1 : x / 2 - 1];
    }
  }
}

void LocalGround::fit(const BlockHeights& blocks, const std::vector<std::uint8_t>& kinds,
                      const RayTable& rays, const LabelRule& plane, const NoiseModel& local_error,
                      double min_window) {
  collect(blocks);
  const double focal = std::max(rays.camera().fx, rays.camera().fy);
  for (std::size_t i = levels_.size(); i-- > 0;) {
    GroundLevel& level = levels_[i];
    const bool first = i + 1 == levels_.size();
    level.min_depth =
        static_cast<float>(min_window * focal / ((2 * kGroundReach + 1) * level.block));
    findDepths(rays, plane, level);
    if (i > 0) {  // the next level begins with it
      level.first_row = 0;
      level.end_row = level.rows;
    }
    average(kinds, level);
    start(first ? nullptr : &levels_[i + 1], level);
    smooth(level, local_error, first ? kFirstClip : kClip);
    smooth(level, local_error, kClip);
  }
}

}  // namespace dominant_plane_detection
