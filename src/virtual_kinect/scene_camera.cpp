#include "virtual_kinect/scene_camera.h"

#include <algorithm>
#include <cmath>

#include "dominant_plane_detection/depth_calibration.h"
#include "virtual_kinect/virtual_kinect.h"

namespace dominant_plane_detection::virtual_kinect {
namespace {

constexpr std::uint16_t kNoDisparity = 2047;

/// The inverse of the reciprocal form: millimetres to raw disparity.
std::uint16_t rawDisparity(std::uint16_t millimetres) {
  if (millimetres == 0) return kNoDisparity;
  static const DepthCalibration calibration = DepthCalibration::kinect();
  const double raw = (1000.0 / millimetres - calibration.a) / calibration.b;
  return raw < 0.0 ? kNoDisparity
                   : static_cast<std::uint16_t>(std::min(std::lround(raw), long{kNoDisparity}));
}

}  // namespace

SceneCamera::SceneCamera(const Scene& scene) : scene_(scene) {}

CameraModel SceneCamera::camera(int width, int height) const {
  CameraModel camera = scene_.camera;
  const double scale = static_cast<double>(width) / camera.width;
  camera.fx *= scale;
  camera.fy *= scale;
  // Pixel centres are whole numbers: the image's edge is half a pixel before the first one.
  camera.cx = (camera.cx + 0.5) * scale - 0.5;
  camera.cy = (camera.cy + 0.5) * scale - 0.5;
  camera.width = width;
  camera.height = height;
  return camera;
}

double SceneCamera::sceneTime(double time) const {
  const double duration = scene_.path.duration();
  if (duration <= 0.0) return 0.0;
  const double phase = std::fmod(time, 2.0 * duration);
  return phase <= duration ? phase : 2.0 * duration - phase;
}

openni2_plugin::Acceleration SceneCamera::acceleration(double scene_time) const {
  const Eigen::Vector3d up =
      pose(scene_time, false).linear().transpose() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d felt = openni2_plugin::kStandardGravity * up;
  return {felt.x(), felt.y(), felt.z()};
}

void SceneCamera::depth(double scene_time, bool from_colour, int width, int height,
                        std::uint32_t frame, std::uint16_t* readings) const {
  const Rendering rendering =
      renderer(width, height).render(pose(scene_time, from_colour), {scene_.noise.shadows, false});
  const std::vector<std::uint16_t> sensed = senseDepth(rendering, scene_.noise, frame);
  std::copy(sensed.begin(), sensed.end(), readings);
}

void SceneCamera::disparity(double scene_time, int width, int height, std::uint32_t frame,
                            std::uint16_t* readings) const {
  depth(scene_time, false, width, height, frame, readings);
  std::transform(readings, readings + static_cast<std::ptrdiff_t>(width) * height, readings,
                 rawDisparity);
}

void SceneCamera::colour(double scene_time, int width, int height, double brightness,
                         std::uint8_t* pixels) const {
  const Rendering rendering = renderer(width, height).render(pose(scene_time, true), {false, true});
  constexpr double kWhite = 255.0;
  std::transform(rendering.colour.begin(), rendering.colour.end(), pixels, [&](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::lround(std::min(brightness * value, kWhite)));
  });
}

void SceneCamera::infrared(double scene_time, int width, int height, std::uint16_t* pixels) const {
  const Rendering rendering =
      renderer(width, height).render(pose(scene_time, false), {scene_.noise.shadows, false});
  constexpr float kFull = 1023.0F;
  for (std::size_t i = 0; i < rendering.depth.size(); ++i) {
    const float z = rendering.depth[i];
    const bool lit = z > 0.0F && (rendering.shadow.empty() || rendering.shadow[i] == 0);
    // The projector's light falls off with the square of the distance.
    const float light = lit ? kFull * rendering.cosine[i] / std::max(z * z, 1.0F) : 0.0F;
    pixels[i] = static_cast<std::uint16_t>(light);
  }
}

const Renderer& SceneCamera::renderer(int width, int height) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::unique_ptr<Renderer>& renderer = renderers_[{width, height}];
  if (!renderer) {
    Scene scene = scene_;
    scene.camera = camera(width, height);
    renderer = std::make_unique<Renderer>(scene);
  }
  return *renderer;
}

Eigen::Isometry3d SceneCamera::pose(double scene_time, bool from_colour) const {
  // About the depth camera's x axis, which points to the right.
  const Eigen::AngleAxisd tilt(tilt_, Eigen::Vector3d::UnitX());
  const Eigen::Isometry3d depth_camera = scene_.path.at(scene_time).pose() * tilt;
  return from_colour ? depth_camera * Eigen::Translation3d(kColourOffset, 0.0, 0.0) : depth_camera;
}

}  // namespace dominant_plane_detection::virtual_kinect
