#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "dominant_plane_detection/camera_model.h"
#include "dominant_plane_detection/depth_image.h"

namespace dominant_plane_detection {

/// A Kinect's pinhole at any resolution.
inline CameraModel testCamera(int width = 640, int height = 480) {
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = 525.0 * width / 640.0;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  return camera;
}

/// "Up" in the optical frame of a camera pitched down and rolled.
/// @param pitch [rad] > 0 looks down.
/// @param roll [rad]
inline Eigen::Vector3d upOf(double pitch, double roll = 0.0) {
  return {std::sin(roll) * std::cos(pitch), -std::cos(roll) * std::cos(pitch), -std::sin(pitch)};
}

/// An image in memory of its own.
template <typename Pixel>
struct OwnedDepth {
  OwnedDepth(int image_width, int image_height)
      : width(image_width),
        height(image_height),
        pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  Pixel& at(int u, int v) {
    return pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(u)];
  }
  DepthView view() const {
    DepthView view;
    view.data = pixels.data();
    view.width = width;
    view.height = height;
    view.step = static_cast<std::size_t>(width) * sizeof(Pixel);
    view.type = sizeof(Pixel) == 2 ? DepthView::Type::kUint16 : DepthView::Type::kFloat32;
    return view;
  }

  int width;
  int height;
  std::vector<Pixel> pixels;
};

/// Depth [m] of a plane along the rays of a camera; 0 where it is not seen.
inline OwnedDepth<float> planeDepth(const CameraModel& camera, const Eigen::Vector3d& up,
                                    double height) {
  OwnedDepth<float> depth(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d ray = camera.ray({u, v});
      const double down = -(up.x() * ray.x() + up.y() * ray.y() + up.z());
      const double z = height / down;
      depth.at(u, v) = down > 0.0 && z < 20.0 ? static_cast<float>(z) : 0.0F;
    }
  }
  return depth;
}

/// Adds an error to the inverse depth of the readings.
/// @param error [1/m] of the pixel (u, v).
template <typename Error>
void shiftInverseDepth(OwnedDepth<float>& depth, Error&& error) {
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      float& z = depth.at(u, v);
      const double shift = error(u, v);
      if (z > 0.0F) z = static_cast<float>(1.0 / (1.0 / static_cast<double>(z) + shift));
    }
  }
}

/// [1/m] An error that is fixed to the pixels, bumps some hundred pixels wide and 1 high.
inline double fixedError(double u, double v) { return std::sin(u / 70.0) * std::cos(v / 50.0); }

/// The same in millimetres, as a sensor gives it.
/// @param sigma_z2 [1/m] standard deviation of the readings per squared depth.
inline OwnedDepth<std::uint16_t> inMillimetres(const OwnedDepth<float>& depth,
                                               double sigma_z2 = 0.0, unsigned seed = 1) {
  OwnedDepth<std::uint16_t> result(depth.width, depth.height);
  std::mt19937 generator(seed);
  std::normal_distribution<double> gauss;
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    const double z = static_cast<double>(depth.pixels[i]);
    const double noisy = z + sigma_z2 * z * z * gauss(generator);
    if (z > 0.0) result.pixels[i] = static_cast<std::uint16_t>(std::lround(1000.0 * noisy));
  }
  return result;
}

}  // namespace dominant_plane_detection
