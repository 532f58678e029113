#include "ros/camera_conversion.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dominant_plane_detection {
namespace {

/// A distortion model, and the numbers of coefficients that it may come with: of OpenCV's, those
/// after the first `used` are of a tilted sensor or a thin prism, and have to be zero.
struct KnownDistortion {
  const char* name;
  DistortionModel model;
  std::size_t used;
  std::vector<std::size_t> sizes;
};

const KnownDistortion* findDistortion(const std::string& name) {
  static const KnownDistortion known[] = {
      {"plumb_bob", DistortionModel::kPlumbBob, 5, {4, 5}},
      {"rational_polynomial", DistortionModel::kRationalPolynomial, 8, {8, 12, 14}}};
  for (const KnownDistortion& each : known) {
    if (name == each.name) return &each;
  }
  return nullptr;
}

bool allZero(std::vector<double>::const_iterator begin, std::vector<double>::const_iterator end) {
  return std::all_of(begin, end, [](double d) { return d == 0.0; });
}

/// @return whether the distortion was understood.
bool readDistortion(const sensor_msgs::CameraInfo& info, CameraModel& camera, std::string& error) {
  if (allZero(info.D.begin(), info.D.end())) return true;
  const KnownDistortion* const known = findDistortion(info.distortion_model);
  if (known == nullptr) {
    error = "expected the distortion model plumb_bob or rational_polynomial, got '" +
            info.distortion_model + "'";
    return false;
  }
  if (std::find(known->sizes.begin(), known->sizes.end(), info.D.size()) == known->sizes.end()) {
    for (const std::size_t size : known->sizes) {
      error += (error.empty() ? "expected " : " or ") + std::to_string(size);
    }
    error += " coefficients of " + info.distortion_model + ", got " + std::to_string(info.D.size());
    return false;
  }
  const auto used =
      info.D.begin() + static_cast<std::ptrdiff_t>(std::min(known->used, info.D.size()));
  if (!allZero(used, info.D.end())) {
    error = "expected the coefficients of " + info.distortion_model + " after the first " +
            std::to_string(known->used) +
            ", of a thin prism and a tilted sensor, to be zero: a depth camera has neither";
    return false;
  }
  camera.distortion = known->model;
  std::copy(info.D.begin(), used, camera.coefficients.begin());
  return true;
}

}  // namespace

ImageSize imageSize(const sensor_msgs::CameraInfo& info) {
  const auto& roi = info.roi;
  const auto side = [](std::uint32_t region, std::uint32_t offset, std::uint32_t all,
                       std::uint32_t binning) {
    return (region != 0 ? region : all - std::min(offset, all)) / std::max(binning, 1U);
  };
  return {side(roi.width, roi.x_offset, info.width, info.binning_x),
          side(roi.height, roi.y_offset, info.height, info.binning_y)};
}

CameraInfoFacts cameraInfoFacts(const sensor_msgs::CameraInfo& info, bool rectified) {
  const ImageSize size = imageSize(info);
  CameraInfoFacts facts;
  facts.frame_id = info.header.frame_id;
  facts.width = static_cast<int>(size.width);
  facts.height = static_cast<int>(size.height);
  facts.fx = rectified ? info.P[0] : info.K[0];
  facts.fy = rectified ? info.P[5] : info.K[4];
  facts.matrix = rectified ? "P" : "K";
  return facts;
}

std::optional<CameraModel> cameraModel(const sensor_msgs::CameraInfo& info, bool rectified,
                                       std::string& error) {
  CameraModel camera;
  if (rectified) {
    camera.fx = info.P[0];
    camera.cx = info.P[2];
    camera.fy = info.P[5];
    camera.cy = info.P[6];
  } else {
    camera.fx = info.K[0];
    camera.cx = info.K[2];
    camera.fy = info.K[4];
    camera.cy = info.K[5];
    if (!readDistortion(info, camera, error)) return std::nullopt;
  }
  const auto& roi = info.roi;
  const std::uint32_t binning_x = std::max(info.binning_x, 1U);
  const std::uint32_t binning_y = std::max(info.binning_y, 1U);
  camera.width = static_cast<int>(imageSize(info).width);
  camera.height = static_cast<int>(imageSize(info).height);
  // Same transformation as image_geometry's PinholeCameraModel: offset first, then scale.
  camera.fx /= binning_x;
  camera.fy /= binning_y;
  camera.cx = (camera.cx - roi.x_offset) / binning_x;
  camera.cy = (camera.cy - roi.y_offset) / binning_y;
  if (!camera.valid()) {
    error = std::string("expected a calibrated camera_info with positive focal lengths in ") +
            (rectified ? "P" : "K") + " and an image size, got f = " + std::to_string(camera.fx) +
            ", " + std::to_string(camera.fy) + " and " + std::to_string(camera.width) + " x " +
            std::to_string(camera.height) + " pixels";
    return std::nullopt;
  }
  return camera;
}

}  // namespace dominant_plane_detection
