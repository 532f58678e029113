#include "core/obstacle_evidence.h"

#include <algorithm>
#include <cmath>

namespace dominant_plane_detection {
namespace {

/// [-] Share of a window that has to be ground, for evidence of something that stands on it.
constexpr float kMinSupport = 0.4F;
/// [-] From here on it does not matter where in the window the ground is. With less, and so much
/// more of it on one side, the ground's height is that of half a window away, and errs more.
constexpr float kBroadSupport = 0.5F;
constexpr float kOneSided = 0.35F;
/// [-] What is asked for there; but for what is wide, as a step or a ramp across the view.
constexpr float kOneSidedErrors = 1.5F;
constexpr int kWide = 2;  // [blocks] to the left and right: seven, with the neighbours of these
/// [-] Windows are at least this much wider than the narrowest obstacle: it must not fill them.
constexpr double kWindowWidths = 1.5;
/// [-] Of three blocks' height, or of a ridge's, what the block itself has over the ground about
/// it: with less, its neighbours are what is high, or the floor close to it is low.
constexpr float kOwnShare = 0.5F;

/// @return whether what ground there is about a block lies on one side of it.
bool isOneSided(const GroundLevel& level, int x, int y) {
  if (level.support[level.at(x, y)] >= kBroadSupport) return false;
  const Rows kept = keptRows(level);
  const auto difference = [&](int dx, int dy) {
    const auto supportAt = [&](int i, int j) {
      return level.support[level.at(std::clamp(i, 0, level.columns - 1),
                                    std::clamp(j, kept.first, kept.end - 1))];
    };
    return std::abs(supportAt(x + dx, y + dy) - supportAt(x - dx, y - dy));
  };
  return std::max(difference(kGroundReach, 0), difference(0, kGroundReach)) >= kOneSided;
}

}  // namespace

double ObstacleEvidence::deviations(std::size_t blocks, double false_alarm_rate) {
  const double share = std::min(false_alarm_rate / static_cast<double>(blocks), 0.5);
  double low = 0.0, high = 40.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > share ? low : high) = middle;
  }
  return high;
}

void ObstacleEvidence::look(const RayTable& rays, const LabelRule& rule, const BlockHeights& blocks,
                            const LowObstacleLimits& limits, std::vector<std::uint8_t>& kinds) {
  limits_ = limits;
  local_ground_.fit(blocks, kinds, rays, rule, limits.local_error,
                    kWindowWidths * limits.min_width);
  smeared_.find(blocks, local_ground_.tiles());
  smeared_.spreadFeet(local_ground_.tiles(), rule, kinds);
  std::size_t all = 0;
  for (const GroundLevel& level : local_ground_.levels()) all += level.size();
  deviations_ = static_cast<float>(deviations(all, limits.false_alarm_rate));
}

bool ObstacleEvidence::isHigh(const GroundLevel& level, int x, int y, float own) const {
  const std::size_t at = level.at(x, y);
  const auto error =
      static_cast<float>(limits_.local_error.sigma(static_cast<double>(level.depth[at])));
  const float limit = deviations_ * error;
  const float over = bumps_.over[at];
  // Two blocks average out less than three, and what is no floor errs more.
  const float scale = bumps_.is_floor[at] != 0.0F ? bumps_.scale : std::max(bumps_.scale, 1.0F);
  if (over >= limit * scale && own >= kOwnShare * over &&
      (over >= kOneSidedErrors * limit * scale || !isOneSided(level, x, y) ||
       isWide(level, x, at, limit * scale))) {
    return true;
  }
  if (level.block != kBlockSize) return false;
  const float ridge = ridges_.height(at);
  return ridge >= limit * ridges_.scale() && own >= kOwnShare * ridge;
}

bool ObstacleEvidence::isWide(const GroundLevel& level, int x, std::size_t at, float limit) const {
  return x >= kWide && x + kWide < level.columns &&
         std::min(bumps_.over[at - kWide], bumps_.over[at + kWide]) >= limit;
}

bool ObstacleEvidence::isEvidence(const GroundLevel& level, int x, int y) const {
  const std::size_t at = level.at(x, y);
  const float own = level.mean[at] - level.ground[at];
  return own >= static_cast<float>(limits_.min_height) && level.depth[at] > 0.0F &&
         level.depth[at] >= level.min_depth && level.support[at] >= kMinSupport &&
         level.isRead(at) && isHigh(level, x, y, own);
}

void ObstacleEvidence::find(const GroundLevel& level, std::vector<Evidence>& evidence) {
  smeared_.findClear(level, clear_);
  bumps_.find(level, clear_, limits_.local_error);
  if (level.block == kBlockSize) ridges_.find(level, bumps_, limits_.local_error);
  evidence.clear();
  evidence.reserve(level.size());
  for (int y = level.first_row; y < level.end_row; ++y) {
    for (int x = 0; x < level.columns; ++x) {
      const std::size_t at = level.at(x, y);
      if (isEvidence(level, x, y)) evidence.push_back({x, y, level.mean[at] - level.ground[at]});
    }
  }
}

}  // namespace dominant_plane_detection
