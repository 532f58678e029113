#include "navigation/obstacle_boxes.h"

#include <algorithm>
#include <cmath>

#include "navigation/told_height.h"

namespace dominant_plane_detection {
namespace {

constexpr float kLeastArea = 0.0016F;  // [m^2] of a thing, seen from the camera: 4 x 4 cm
/// [m] Ground that looks bent begins at the ground band, 0.12 m at 4 m, or where limits do: what
/// begins this much over a thing's foot is none.
constexpr double kAboveBent = 0.05;
constexpr float kSteepShare = 0.15F;                     // [-] of a thing, at least
constexpr double kLargeLength = 1.2, kLargeWidth = 0.4;  // [m] what is both is divided

}  // namespace

const std::vector<UprightBox>& ObstacleBoxes::find(const DepthView& depth, const RayTable& rays,
                                                   const Detection& detection,
                                                   const ObstacleLimits& limits,
                                                   const NoiseModel& local_error) {
  boxes_.clear();
  if (!detection.found()) return boxes_;
  things_.find(depth, rays, detection, limits);
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (isThing(things_.begin(i), things_.end(i), limits, local_error)) {
      draw(things_.begin(i), things_.end(i), limits);
    }
  }
  std::sort(boxes_.begin(), boxes_.end(),
            [](const UprightBox& a, const UprightBox& b) { return a.distance < b.distance; });
  return boxes_;
}

/// @return [m^2] as seen from the camera.
float ObstacleBoxes::areaOf(const ObstaclePoint* first, const ObstaclePoint* last) const {
  float area = 0.0F;
  for (const ObstaclePoint* p = first; p != last; ++p) {
    area += things_.pixelArea() * p->z * p->z;
  }
  return area;
}

bool ObstacleBoxes::isThing(const ObstaclePoint* first, const ObstaclePoint* last,
                            const ObstacleLimits& limits, const NoiseModel& local_error) const {
  if (areaOf(first, last) < kLeastArea) return false;
  float steep = 0.0F, nearest = INFINITY, lowest = INFINITY, highest = 0.0F;
  for (const ObstaclePoint* p = first; p != last; ++p) {
    steep += p->steep ? 1.0F : 0.0F;
    nearest = std::min(nearest, p->z);
    lowest = std::min(lowest, p->height);
    highest = std::max(highest, p->height);
  }
  if (static_cast<double>(lowest) >= footHeight(limits) + kAboveBent) return true;
  const bool has_face =
      things_.looksDown() || steep >= kSteepShare * static_cast<float>(last - first);
  return has_face &&
         static_cast<double>(highest) >= toldHeight(local_error, static_cast<double>(nearest));
}

/// In the middle of its length, until no part is large.
void ObstacleBoxes::draw(ObstaclePoint* first, ObstaclePoint* last, const ObstacleLimits& limits) {
  UprightBox box = fitter_.fit(first, last);
  if (box.length <= kLargeLength || box.width <= kLargeWidth) {
    if (box.bottom < footHeight(limits)) box.bottom = 0.0;
    boxes_.push_back(box);
    return;
  }
  const Eigen::Vector2f ahead(static_cast<float>(std::cos(box.yaw)),
                              static_cast<float>(std::sin(box.yaw)));
  const float middle = ahead.dot(box.centre.cast<float>());
  ObstaclePoint* const second = std::partition(first, last, [&](const ObstaclePoint& p) {
    return ahead.x() * p.x + ahead.y() * p.y < middle;
  });
  if (areaOf(first, second) >= kLeastArea) draw(first, second, limits);
  if (areaOf(second, last) >= kLeastArea) draw(second, last, limits);
}

}  // namespace dominant_plane_detection
