#include "ros/camera_conversion.h"

#include <sensor_msgs/distortion_models.h>

#include <algorithm>

namespace dominant_plane_detection {
namespace {

/// @return whether the distortion was understood.
bool readDistortion(const sensor_msgs::CameraInfo& info, CameraModel& camera, std::string& error) {
  const bool all_zero =
      std::all_of(info.D.begin(), info.D.end(), [](double d) { return d == 0.0; });
  if (all_zero) return true;
  std::size_t expected = 0;
  if (info.distortion_model == sensor_msgs::distortion_models::PLUMB_BOB) {
    camera.distortion = DistortionModel::kPlumbBob;
    expected = 5;
  } else if (info.distortion_model == sensor_msgs::distortion_models::RATIONAL_POLYNOMIAL) {
    camera.distortion = DistortionModel::kRationalPolynomial;
    expected = 8;
  } else {
    error = "expected the distortion model plumb_bob or rational_polynomial, got '" +
            info.distortion_model + "'";
    return false;
  }
  if (info.D.size() != expected) {
    error = "expected " + std::to_string(expected) + " coefficients of " + info.distortion_model +
            ", got " + std::to_string(info.D.size());
    return false;
  }
  std::copy(info.D.begin(), info.D.end(), camera.coefficients.begin());
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
