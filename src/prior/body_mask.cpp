#include "prior/body_mask.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace dominant_plane_detection {
namespace {

constexpr double kNear = 0.05;  // [m] nearer, a corner's pixel says nothing
/// Readings that are nearer than anything is trusted: no ground is missing where the body is.
constexpr std::uint16_t kMaskedUnits = 1;
constexpr float kMaskedMetres = 0.001F;

}  // namespace

/// @return where the box may be seen: the whole image where some of its corners are beside or
/// behind the camera, or its lens bends lines.
BodyMask::Region BodyMask::regionOf(const Box& box, const CameraModel& model,
                                    const Eigen::Isometry3d& camera) {
  const Region all{0, model.width, 0, model.height};
  const Eigen::Isometry3d to_camera = camera.inverse();
  Eigen::Array2d low = Eigen::Array2d::Constant(INFINITY), high = -low;
  int behind = 0;
  for (int k = 0; k < 8; ++k) {
    const auto corner = box.corner(static_cast<Box::CornerType>(k));
    const Eigen::Vector3d at = to_camera * corner;
    if (at.z() < kNear) {
      ++behind;
      continue;
    }
    const Eigen::Array2d pixel(model.cx + model.fx * at.x() / at.z(),
                               model.cy + model.fy * at.y() / at.z());
    low = low.min(pixel);
    high = high.max(pixel);
  }
  if (behind == 8) return {0, 0, 0, 0};
  if (behind > 0 || model.distortion != DistortionModel::kNone) return all;
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

void BodyMask::take(const DepthView& depth, int u, int v) {
  const std::size_t at = static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width) +
                         static_cast<std::size_t>(u);
  if (depth.type == DepthView::Type::kUint16) {
    reinterpret_cast<std::uint16_t*>(pixels_.data())[at] = kMaskedUnits;
  } else {
    reinterpret_cast<float*>(pixels_.data())[at] = kMaskedMetres;
  }
}

DepthView BodyMask::mask(const DepthView& depth, const RayTable& rays,
                         const Eigen::Isometry3d& camera) {
  const Eigen::Matrix3f rotation = camera.linear().cast<float>();
  const Eigen::Vector3f origin = camera.translation().cast<float>();
  bool copied = false;
  for (const Box& box : boxes_) {
    const Eigen::AlignedBox3f body = box.cast<float>();
    // Beyond its farthest corner nothing is in it.
    const auto farthest = static_cast<float>((box.center() - camera.translation()).norm() +
                                             0.5 * box.diagonal().norm());
    const Region region = regionOf(box, rays.camera(), camera);
    for (int v = region.top; v < region.bottom; ++v) {
      for (int u = region.left; u < region.right; ++u) {
        const float z = metresAt(depth, u, v);
        if (!(z > 0.0F && z < farthest)) continue;
        if (!body.contains(Eigen::Vector3f(rotation * (z * rays.ray(u, v)) + origin))) continue;
        if (!copied) copy(depth);
        copied = true;
        take(depth, u, v);
      }
    }
  }
  if (!copied) return depth;
  DepthView masked = depth;
  masked.data = pixels_.data();
  masked.step = static_cast<std::size_t>(depth.width) * pixelSize(depth.type);
  return masked;
}

}  // namespace dominant_plane_detection
