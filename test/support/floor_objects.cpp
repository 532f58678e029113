#include "support/floor_objects.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "dominant_plane_detection/noise_model.h"
#include "synthetic/renderer.h"

namespace dominant_plane_detection {
namespace {

constexpr int kWindow = 41;        // [px]
constexpr double kShare = 0.7;     // [-] of floor in the window
constexpr double kSigmas = 6.0;    // [-]
constexpr double kReadings = 0.5;  // [-] of an object's pixels

Eigen::Isometry3d worldFromCamera(const ReferenceImage& image) {
  const Eigen::Vector3d up = image.up.normalized();
  const Eigen::Vector3d ahead = (Eigen::Vector3d::UnitZ() - up.z() * up).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().row(0) = ahead;
  pose.linear().row(1) = up.cross(ahead);
  pose.linear().row(2) = up;
  pose.translation().z() = image.height;
  return pose;
}

}  // namespace

cv::Mat floorMask(const ReferenceSet& set, const ReferenceImage& image) {
  cv::Mat share;
  cv::Mat ground;
  image.ground.convertTo(ground, CV_32F, 1.0 / 255.0);
  cv::blur(ground, share, {kWindow, kWindow});
  cv::Mat floor = cv::Mat::zeros(image.ground.size(), CV_8U);
  const DepthView view = set.view(image);
  for (int v = 0; v < floor.rows; ++v) {
    for (int u = 0; u < floor.cols; ++u) {
      if (share.at<float>(v, u) < kShare) continue;
      const Eigen::Vector3d point = set.point(view, u, v);
      const double height = image.up.dot(point) + image.height;
      const bool near = std::abs(height) < kSigmas * NoiseModel{}.sigma(point.z());
      if (point.z() == 0.0 || near) floor.at<std::uint8_t>(v, u) = 255;
    }
  }
  for (const cv::Rect& object : image.objects) floor(object).setTo(0);
  return floor;
}

FloorObjects::FloorObjects(const ReferenceSet& set, const ReferenceImage& image)
    : set_(set),
      image_(image),
      world_from_camera_(worldFromCamera(image)),
      floor_(floorMask(set, image)) {}

double FloorObjects::planeDepth(int u, int v) const {
  const double down = -image_.up.dot(set_.camera.ray({u, v}).homogeneous());
  return down > 0.0 ? image_.height / down : 0.0;
}

Eigen::Vector3d FloorObjects::planePoint(int u, int v) const {
  return world_from_camera_ * (planeDepth(u, v) * set_.camera.ray({u, v}).homogeneous());
}

std::optional<StoodIn> FloorObjects::stand(TriangleMesh object, int u, int v, int smear) const {
  if (planeDepth(u, v) <= 0.0 || floor_.at<std::uint8_t>(v, u) != 255) return std::nullopt;
  Scene scene;
  scene.camera = set_.camera;
  scene.add(std::move(object), Eigen::Isometry3d(Eigen::Translation3d(planePoint(u, v))));
  const Rendering rendering = Renderer(scene).render(world_from_camera_, {});

  StoodIn result;
  cv::Mat added = cv::Mat::zeros(image_.depth.size(), CV_64F);  // [m]
  const DepthView view = set_.view(image_);
  std::size_t seen = 0;
  for (int y = 0; y < rendering.height; ++y) {
    for (int x = 0; x < rendering.width; ++x) {
      const int index = y * rendering.width + x;
      const auto object_z = static_cast<double>(rendering.depth[static_cast<std::size_t>(index)]);
      if (object_z == 0.0) continue;
      const bool border = x == 0 || y == 0 || x + 1 == rendering.width || y + 1 == rendering.height;
      if (border || floor_.at<std::uint8_t>(y, x) != 255) return std::nullopt;
      ++seen;
      const auto reading = static_cast<double>(metresAt(view, x, y));
      if (reading == 0.0) continue;
      const double plane_z = planeDepth(x, y);
      const double error = (reading - plane_z) * std::pow(object_z / plane_z, 2);
      added.at<double>(y, x) = object_z + error - reading;
      result.pixels.push_back(index);
    }
  }
  if (static_cast<double>(result.pixels.size()) <= kReadings * static_cast<double>(seen)) {
    return std::nullopt;
  }
  if (smear > 1) cv::blur(added, added, {smear, smear});
  result.depth = image_.depth.clone();
  for (int i = 0; i < rendering.width * rendering.height; ++i) {
    const int y = i / rendering.width, x = i % rendering.width;
    std::uint16_t& reading = result.depth.at<std::uint16_t>(y, x);
    if (reading == 0 || added.at<double>(y, x) == 0.0) continue;
    const double units =
        reading + added.at<double>(y, x) / static_cast<double>(set_.metres_per_unit);
    reading = static_cast<std::uint16_t>(std::clamp(std::lround(units), 1L, 65535L));
  }
  return result;
}

}  // namespace dominant_plane_detection
