#include "navigation/scan_figures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/ray_table.h"
#include "navigation/ground_scan.h"
#include "navigation/room_things.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kRange = 3.8;  // [m] nearer than any wall; readings beyond are not judged

/// What really is in each direction, half a degree wide.
class Truth {
 public:
  Truth(const RoomOfThings& room, const Rendering& exact) : things_(room.things.size()) {
    RayTable rays;
    rays.build(room.scene.camera);
    const Eigen::Isometry3d camera = room.scene.path.keys.front().pose();
    for (int v = 0; v < exact.height; ++v) {
      for (int u = 0; u < exact.width; ++u) {
        const std::size_t i = static_cast<std::size_t>(v * exact.width + u);
        const bool obstacle = exact.labels[i] == static_cast<std::uint8_t>(Label::kObstacle);
        if (!obstacle || !(exact.depth[i] > 0.0F)) continue;
        const double depth = static_cast<double>(exact.depth[i]);
        add(camera * (depth * rays.ray(u, v).cast<double>()), room.things);
      }
    }
  }

  /// @return [m] the obstacle that is nearest to a reading, of those in its direction and in those
  /// about it, which the pixels at its border may be in.
  std::optional<double> nearestTo(double range, double angle) const {
    std::optional<double> best;
    for (int k = directionOf(angle) - 1; k <= directionOf(angle) + 1; ++k) {
      const auto found = ranges_.find(k);
      if (found == ranges_.end()) continue;
      for (const double at : found->second) {
        if (!best || std::abs(at - range) < std::abs(*best - range)) best = at;
      }
    }
    return best;
  }
  /// @return [m] the nearest obstacle in just this direction.
  std::optional<double> nearest(double angle) const {
    const auto found = ranges_.find(directionOf(angle));
    if (found == ranges_.end()) return std::nullopt;
    return *std::min_element(found->second.begin(), found->second.end());
  }

  struct Seen {
    int pixels = 0;
    double range = INFINITY;                     ///< [m] nearest
    std::map<int, double> nearest_by_direction;  ///< [m]
    std::map<int, int> pixels_by_direction;
  };
  /// @return what there is of a thing where nothing else is nearer: more cannot be in a scan.
  Seen inFront(std::size_t k) const {
    Seen in_front;
    for (const auto& [direction, range] : things_[k].nearest_by_direction) {
      const std::vector<double>& all = ranges_.at(direction);
      if (*std::min_element(all.begin(), all.end()) < range) continue;
      in_front.nearest_by_direction[direction] = range;
      in_front.range = std::min(in_front.range, range);
      in_front.pixels += things_[k].pixels_by_direction.at(direction);
    }
    return in_front;
  }
  static int directionOf(double angle) {
    return static_cast<int>(std::floor(angle / (0.5 * kDegree) + 0.5));
  }

 private:
  void add(const Eigen::Vector3d& point, const std::vector<Thing>& things) {
    const double range = point.head<2>().norm();
    const int direction = directionOf(std::atan2(point.y(), point.x()));
    ranges_[direction].push_back(range);
    for (std::size_t k = 0; k < things.size(); ++k) {
      if (!things[k].contains(point)) continue;
      Seen& seen = things_[k];
      ++seen.pixels_by_direction[direction];
      seen.range = std::min(seen.range, range);
      const auto [at, first] = seen.nearest_by_direction.emplace(direction, range);
      if (!first) at->second = std::min(at->second, range);
      return;
    }
  }

  std::map<int, std::vector<double>> ranges_;  ///< [m] of all obstacle pixels in a direction
  std::vector<Seen> things_;
};

/// A reading in a direction, both against where the camera looks.
struct Reading {
  double angle, range;
};

std::vector<Reading> readingsOf(const GroundScan& scan) {
  std::vector<Reading> readings;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!std::isfinite(scan.ranges[i])) continue;
    readings.push_back({scan.angle(i), static_cast<double>(scan.ranges[i])});
  }
  return readings;
}

/// Ten rows of one column, as if the camera stood upright.
std::vector<Reading> fixedColumns(const DepthView& depth, const CameraModel& camera) {
  constexpr int kRows = 10;
  std::vector<Reading> readings;
  for (int u = camera.width - 1; u >= 0; --u) {
    double nearest = INFINITY;
    for (int v = (camera.height - kRows) / 2; v < (camera.height + kRows) / 2; ++v) {
      const double z = static_cast<double>(metresAt(depth, u, v));
      const double range = z * std::hypot(1.0, (u - camera.cx) / camera.fx);
      if (z >= 0.45 && range < nearest) nearest = range;
    }
    if (std::isfinite(nearest)) {
      readings.push_back({-std::atan2(u - camera.cx, camera.fx), nearest});
    }
  }
  return readings;
}

void judge(const std::vector<Reading>& readings, const Truth& truth, ScanFigures& figures) {
  int ghost_direction = -1000000;
  for (const Reading& reading : readings) {
    if (reading.range > kRange) continue;
    const auto thing = truth.nearestTo(reading.range, reading.angle);
    const double off = thing ? std::abs(*thing - reading.range) : INFINITY;
    if (off > std::max(0.1, 0.05 * reading.range)) {
      const int direction = Truth::directionOf(reading.angle);
      figures.ghosts += direction > ghost_direction + 1;
      ghost_direction = direction;
      continue;
    }
    const auto nearest = truth.nearest(reading.angle);
    if (!nearest) continue;
    figures.off.push_back(std::abs(*nearest - reading.range));
    figures.relative.push_back(figures.off.back() / *nearest);
  }
}

bool isSeen(const Truth::Seen& thing, const std::vector<Reading>& readings) {
  return std::any_of(readings.begin(), readings.end(), [&](const Reading& reading) {
    const auto at = thing.nearest_by_direction.find(Truth::directionOf(reading.angle));
    return at != thing.nearest_by_direction.end() &&
           std::abs(at->second - reading.range) < std::max(0.05, 0.05 * at->second);
  });
}

}  // namespace

ScanFigures scanFigures(ErrorKind error, ScanRule rule, std::uint32_t first, int count) {
  ScanFigures figures;
  DominantPlaneDetector detector(parametersOf(error));
  GroundScanner scanner;
  RayTable rays;
  for (std::uint32_t seed = first; seed < first + static_cast<std::uint32_t>(count); ++seed) {
    const RoomOfThings room = roomOfThings(seed);
    Layers layers;
    layers.shadow = true;
    const CameraModel& camera = room.scene.camera;
    const Rendering exact =
        Renderer(room.scene).render(room.scene.path.keys.front().pose(), layers);
    const std::vector<std::uint16_t> pixels = readDepth(exact, error, seed);
    DepthView view;
    view.data = pixels.data();
    view.width = camera.width;
    view.height = camera.height;
    view.step = 2 * static_cast<std::size_t>(camera.width);
    Prior prior;
    prior.expected_up = exact.normal;
    prior.up_source = UpSource::kTf;
    prior.expected_height = Prior::ExpectedHeight{exact.distance, 0.15};
    const Detection& detection = detector.detect(view, camera, prior);
    rays.build(camera);
    ++figures.images;
    figures.found += detection.found();
    const std::vector<Reading> readings = rule == ScanRule::kGround
                                              ? readingsOf(scanner.scan(view, rays, detection, {}))
                                              : fixedColumns(view, camera);
    const Truth truth(room, exact);
    judge(readings, truth, figures);
    for (std::size_t k = 0; k < room.things.size(); ++k) {
      const Truth::Seen thing = truth.inFront(k);
      if (thing.pixels < 60 || thing.range > 2.5) continue;
      const double height = room.things[k].size.z();
      const bool seen = isSeen(thing, readings);
      if (height >= 0.1) {
        ++figures.high;
        figures.high_seen += seen;
      } else if (height >= 0.05) {
        ++figures.low;
        figures.low_seen += seen;
      }
    }
  }
  return figures;
}

}  // namespace dominant_plane_detection
