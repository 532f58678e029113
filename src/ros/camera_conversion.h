#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <cstdint>
#include <optional>
#include <string>

#include "doctor/facts.h"
#include "dominant_plane_detection/camera_model.h"

namespace dominant_plane_detection {

struct ImageSize {
  std::uint32_t width;   ///< [px]
  std::uint32_t height;  ///< [px]
};

/// @return of the images that come with a camera_info: binning and region of interest are taken off
/// (REP 104; a binning of 0 means 1, a region of size 0 the whole image).
ImageSize imageSize(const sensor_msgs::CameraInfo& info);

/// What can be said of a camera_info whether or not it can be used.
/// @param rectified P instead of K.
CameraInfoFacts cameraInfoFacts(const sensor_msgs::CameraInfo& info, bool rectified);

/// Makes the camera of the images that come with a camera_info.
/// @param rectified false: K and D (plumb_bob with 4 or 5 coefficients, rational_polynomial with 8,
/// or with 12 or 14 of which the rest are zero; empty: none); true: P alone, for images that are
/// rectified already.
/// @param error one sentence with what was expected and what came, if there is no camera.
/// @return the camera at the resolution and in the region that the images have, see `imageSize`.
std::optional<CameraModel> cameraModel(const sensor_msgs::CameraInfo& info, bool rectified,
                                       std::string& error);

}  // namespace dominant_plane_detection
