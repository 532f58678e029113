#include "doctor/shadow_sides.h"

#include <cmath>
#include <optional>
#include <utility>

namespace dominant_plane_detection {
namespace {

/// Baselines of the cameras: 50 mm (RealSense D435) to 95 mm (D455); a Kinect's is 75 mm. An edge's
/// smear makes a gap a little narrower or wider.
constexpr double kLeastBaseline = 0.04;  // [m]
constexpr double kMostBaseline = 0.10;   // [m]
constexpr int kLeastGap = 4;             // [px] narrower ones are noise
constexpr int kMargin = 4;               // [px] with readings on either side of a gap
constexpr float kFarthest = 10.0F;       // [m] beyond it readings are noise
constexpr int kRowStep = 2;              // [px]

bool isReading(float z) { return z > 0.0F && z < kFarthest; }

/// @return [px] where readings begin again.
int endOfGap(const DepthView& depth, int begin, int v) {
  int u = begin;
  while (u < depth.width && !(metresAt(depth, u, v) > 0.0F)) ++u;
  return u;
}

bool allReadings(const DepthView& depth, int begin, int end, int v) {
  if (begin < 0 || end > depth.width) return false;
  for (int u = begin; u < end; ++u) {
    if (!isReading(metresAt(depth, u, v))) return false;
  }
  return true;
}

/// @return whether a gap is as wide as a camera of the kind would make it.
bool isShadow(int width, float left, float right, double fx) {
  const double disparity =
      fx * std::abs(1.0 / static_cast<double>(left) - 1.0 / static_cast<double>(right));
  return width >= kLeastGap && kLeastBaseline * disparity <= width &&
         width <= kMostBaseline * disparity;
}

}  // namespace

ShadowSides shadowSides(const DepthView& depth, const CameraModel& camera) {
  ShadowSides sides;
  for (int v = 0; v < depth.height; v += kRowStep) {
    for (int u = 0; u < depth.width; ++u) {
      if (metresAt(depth, u, v) > 0.0F) continue;
      const int begin = std::exchange(u, endOfGap(depth, u, v));
      if (!allReadings(depth, begin - kMargin, begin, v)) continue;
      if (!allReadings(depth, u, u + kMargin, v)) continue;
      const float left = metresAt(depth, begin - 1, v), right = metresAt(depth, u, v);
      if (!isShadow(u - begin, left, right, camera.fx)) continue;
      ++(right < left ? sides.left : sides.right);
    }
  }
  return sides;
}

}  // namespace dominant_plane_detection
