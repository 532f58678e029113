#include "support/surface_figures.h"

#include <algorithm>
#include <cmath>

#include "core/plane_moments.h"
#include "synthetic/camera_rays.h"
#include "synthetic/ground_scenes.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;
constexpr double kNearest = 0.5, kFarthest = 4.0;  // [m]

/// Errors of the depth itself: smooth ones, 20 to 40 px long, and independent ones.
std::vector<std::uint16_t> readSmoothly(const Rendering& rendering, std::uint32_t seed) {
  constexpr double kSmooth = 0.8, kWhite = 0.25;  // [-] in sigma(z)
  const NoiseModel noise;
  PixelNoise random(seed);
  const double length = 20.0 + 20.0 * static_cast<double>(random.uniform());
  const SmoothError smooth({{length, 1.0, 0.0}}, rendering.width, rendering.height, random);
  const auto width = static_cast<std::size_t>(rendering.width);
  std::vector<float> share(width), unused(width);
  std::vector<std::uint16_t> depth(rendering.depth.size(), 0);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (i % width == 0) smooth.row(static_cast<int>(i / width), share, unused);
    const auto z = static_cast<double>(rendering.depth[i]);
    const double error = kSmooth * static_cast<double>(share[i % width]) +
                         kWhite * static_cast<double>(random.gauss());
    const double reading = z + noise.sigma(z) * error;
    if (z > 0.3 && reading < 8.0) depth[i] = static_cast<std::uint16_t>(std::lround(1e3 * reading));
  }
  return depth;
}

}  // namespace

std::vector<std::uint16_t> readDepth(const Rendering& rendering, ErrorKind error,
                                     std::uint32_t seed) {
  if (error == ErrorKind::kSmooth) return readSmoothly(rendering, seed);
  return senseDepth(rendering,
                    error == ErrorKind::kKinect ? SensorNoise() : SensorNoise::realsense(), seed);
}

Parameters parametersOf(ErrorKind error) {
  constexpr NoiseModel kSmoothErrors[] = {{0.0003, 0.0002}, {0.0017, 0.00057}, {0.0006, 0.00043}};
  Parameters parameters;
  parameters.smooth_error = kSmoothErrors[static_cast<std::size_t>(error)];
  return parameters;
}

double SurfaceError::relative() const { return std::max(angle / (0.3 * kDegree), height / 0.005); }

SurfaceImage::SurfaceImage(const SurfaceScene& scene, ErrorKind error, std::uint32_t seed)
    : camera_(scene.scene.camera) {
  const Eigen::Isometry3d pose = scene.scene.path.keys.front().pose();
  const Rendering rendering = Renderer(scene.scene).render(pose, {true, false, false});
  shown_ = shownSurfaces(scene, rendering);
  depth_ = readDepth(rendering, error, seed);
  for (const Surface& surface : scene.surfaces) {
    surfaces_.push_back({pose.linear().transpose() * surface.normal,
                         surface.offset - surface.normal.dot(pose.translation())});
  }
}

DepthView SurfaceImage::view() const { return {depth_.data(), camera_.width, camera_.height}; }

std::size_t SurfaceImage::readings(std::size_t surface) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    count += shown_[i] == static_cast<int>(surface) && depth_[i] >= 1e3 * kNearest &&
             depth_[i] <= 1e3 * kFarthest;
  }
  return count;
}

SurfaceError SurfaceImage::error(const Eigen::Vector3d& normal, double distance,
                                 std::size_t surface) const {
  const Surface& truth = surfaces_[surface];
  return {std::acos(std::clamp(normal.dot(truth.normal), -1.0, 1.0)),
          std::abs(distance + truth.offset)};
}

std::size_t SurfaceImage::nearest(const Eigen::Vector3d& normal, double distance) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < surfaces_.size(); ++i) {
    if (error(normal, distance, i).relative() < error(normal, distance, best).relative()) best = i;
  }
  return best;
}

std::optional<SurfaceError> SurfaceImage::fitError(std::size_t surface) const {
  const NoiseModel noise;
  const std::vector<Eigen::Vector2f> rays = cameraRays(camera_);
  PlaneMoments moments;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    const double z = 1e-3 * depth_[i];
    if (shown_[i] != static_cast<int>(surface) || z < kNearest || z > kFarthest) continue;
    const double sigma = noise.sigma(z);
    moments.add(z * rays[i].cast<double>().homogeneous(), 1.0 / (sigma * sigma));
  }
  const std::optional<PlaneFit> fit = moments.fit();
  if (!fit) return std::nullopt;
  return error(-fit->plane.normal, fit->plane.distance, surface);
}

std::optional<double> SurfaceImage::stepFrom(std::size_t surface) const {
  std::optional<double> least;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    if (i == surface) continue;
    if (surfaces_[surface].normal.dot(surfaces_[i].normal) < 1.0 - 1e-9) return std::nullopt;
    const double step = std::abs(surfaces_[surface].offset - surfaces_[i].offset);
    least = std::min(least.value_or(step), step);
  }
  return least;
}

std::vector<LabelCase> labelCases() {
  const auto between = [](double low, double high, double share) {
    return low + share * (high - low);
  };
  const auto step = [=](double height, double nearest) {
    return [=](double s) { return twoLevelScene(height, between(nearest, 2.0, s)); };
  };
  return {
      {"floor alone", [](double) { return twoLevelScene(0.1, 9.0); }, Label::kUnknown},
      {"ramp of 8 degrees at 1.5 to 2 m",
       [=](double s) { return rampScene(8.0 * kDegree, between(1.5, 2.0, s)); }, Label::kObstacle},
      {"kerb of 30 mm along the view",
       [=](double s) { return kerbScene(0.03, between(0.1, 0.4, s)); }, Label::kObstacle},
      {"30 mm higher from 1.5 to 2 m", step(0.03, 1.5), Label::kObstacle},
      {"50 mm lower from 1 to 2 m", step(-0.05, 1.0), Label::kDropOff},
      {"100 mm lower from 1 to 2 m", step(-0.1, 1.0), Label::kDropOff},
      {"1 m lower from 1 to 2 m", step(-1.0, 1.0), Label::kDropOff}};
}

LabelFigures labelFigures(const LabelCase& which, double share, ErrorKind error,
                          std::uint32_t seed) {
  constexpr double kFarthestFloor = 2.5;  // [m]
  const Scene scene = which.scene(share);
  const Rendering rendering =
      Renderer(scene).render(scene.path.keys.front().pose(), {true, false, false});
  const std::vector<std::uint16_t> depth = readDepth(rendering, error, seed);
  DominantPlaneDetector detector(parametersOf(error));
  Prior prior;
  prior.height_range = Prior::HeightRange{rendering.distance - 0.015, rendering.distance + 0.015};
  const Detection& detection =
      detector.detect({depth.data(), rendering.width, rendering.height}, scene.camera, prior);
  LabelFigures figures;
  figures.found = detection.found();
  std::size_t right = 0, ground = 0;
  const std::vector<Eigen::Vector2f> rays = cameraRays(scene.camera);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] == 0) continue;
    const auto truth = static_cast<Label>(rendering.labels[i]);
    const auto label = static_cast<Label>(detection.labels[i]);
    if (truth == Label::kGround) figures.false_drop_off += label == Label::kDropOff;
    if (truth != which.truth) continue;
    // The floor's height over the ray at the depth that is asked for.
    const Eigen::Vector3d ray = rays[i].cast<double>().homogeneous();
    if (kFarthestFloor * rendering.normal.dot(ray) + rendering.distance > 0.0) continue;
    ++figures.other;
    right += label == which.truth;
    ground += label == Label::kGround;
  }
  if (figures.other == 0) return figures;
  figures.right = static_cast<double>(right) / static_cast<double>(figures.other);
  figures.ground = static_cast<double>(ground) / static_cast<double>(figures.other);
  return figures;
}

}  // namespace dominant_plane_detection
