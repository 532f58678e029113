#include "prior/body_mask.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace dominant_plane_detection {
namespace {

constexpr double kNear = 0.05;  // [m] nearer, a corner's pixel says nothing

}  // namespace

/// @return where the box may be seen: the whole image where a corner is beside or behind the
/// camera, or its lens bends lines.
BodyMask::Region BodyMask::regionOf(const Box& box, const CameraModel& model,
                                    const Eigen::Isometry3d& camera) {
  const Region all{0, model.width, 0, model.height};
  if (model.distortion != DistortionModel::kNone) return all;
  const Eigen::Isometry3d to_camera = camera.inverse();
  Eigen::Array2d low = Eigen::Array2d::Constant(INFINITY), high = -low;
  for (int k = 0; k < 8; ++k) {
    const auto corner = box.corner(static_cast<Box::CornerType>(k));
    const Eigen::Vector3d at = to_camera * corner;
    if (at.z() < kNear) return all;
    const Eigen::Array2d pixel(model.cx + model.fx * at.x() / at.z(),
                               model.cy + model.fy * at.y() / at.z());
    low = low.min(pixel);
    high = high.max(pixel);
  }
  const auto within = [](double value, int end) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(end)));
  };
  return {within(std::floor(low.x()), model.width), within(std::ceil(high.x()) + 1.0, model.width),
          within(std::floor(low.y()), model.height),
          within(std::ceil(high.y()) + 1.0, model.height)};
}

void BodyMask::copy(const DepthView& depth) {
  const std::size_t row = static_cast<std::size_t>(depth.width) * pixelSize(depth.type);
  pixels_.resize(row * static_cast<std::size_t>(depth.height));
  for (int v = 0; v < depth.height; ++v) {
    std::memcpy(pixels_.data() + static_cast<std::size_t>(v) * row, depth.row<std::uint8_t>(v),
                row);
  }
}

DepthView BodyMask::mask(const DepthView& depth, const RayTable& rays,
                         const Eigen::Isometry3d& camera) {
  const std::size_t size = pixelSize(depth.type);
  const Eigen::Matrix3f rotation = camera.linear().cast<float>();
  const Eigen::Vector3f origin = camera.translation().cast<float>();
  bool copied = false;
  for (const Box& box : boxes_) {
    const Eigen::AlignedBox3f body = box.cast<float>();
    const Region region = regionOf(box, rays.camera(), camera);
    for (int v = region.top; v < region.bottom; ++v) {
      for (int u = region.left; u < region.right; ++u) {
        const float z = metresAt(depth, u, v);
        if (!(z > 0.0F) ||
            !body.contains(Eigen::Vector3f(rotation * (z * rays.ray(u, v)) + origin))) {
          continue;
        }
        if (!copied) copy(depth);
        copied = true;
        // 0 is no reading in either type.
        std::memset(
            pixels_.data() + (static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width) +
                              static_cast<std::size_t>(u)) *
                                 size,
            0, size);
      }
    }
  }
  if (!copied) return depth;
  DepthView masked = depth;
  masked.data = pixels_.data();
  masked.step = static_cast<std::size_t>(depth.width) * size;
  return masked;
}

}  // namespace dominant_plane_detection
