#include "ros/overlay.h"

#include <algorithm>
#include <cstdint>

namespace dominant_plane_detection {
namespace {

const cv::Vec3b kNoReading(72, 32, 24);
const cv::Vec3b kObstacleTint(60, 60, 255);
const cv::Vec3b kDropOffTint(0, 220, 255);
const cv::Vec3b kMissingGroundTint(255, 60, 200);

cv::Vec3b tinted(const cv::Vec3b& pixel, const cv::Vec3b& tint) {
  cv::Vec3b mixed;
  for (int i = 0; i < 3; ++i) mixed[i] = static_cast<std::uint8_t>((2 * pixel[i] + tint[i]) / 3);
  return mixed;
}

}  // namespace

cv::Mat greyPicture(const DepthView& depth) {
  cv::Mat picture(depth.height, depth.width, CV_8UC3);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      const float z = metresAt(depth, u, v);
      // Linear in inverse depth, as the sensor's own disparity: half a metre is white.
      const float grey = std::clamp(120.0F / z + 15.0F, 0.0F, 255.0F);
      picture.at<cv::Vec3b>(v, u) =
          z > 0.0F ? cv::Vec3b::all(static_cast<std::uint8_t>(grey)) : kNoReading;
    }
  }
  return picture;
}

void paintOverlay(const Detection& detection, cv::Mat& picture) {
  for (int v = 0; v < detection.image_height; ++v) {
    for (int u = 0; u < detection.image_width; ++u) {
      cv::Vec3b& pixel = picture.at<cv::Vec3b>(v, u);
      switch (detection.label(u, v)) {
        case Label::kGround:
          pixel = cv::Vec3b::all(0);
          break;
        case Label::kObstacle:
          pixel = tinted(pixel, kObstacleTint);
          break;
        case Label::kDropOff:
          pixel = tinted(pixel, kDropOffTint);
          break;
        case Label::kMissingGround:
          pixel = tinted(pixel, kMissingGroundTint);
          break;
        case Label::kUnknown:
          break;
      }
    }
  }
}

}  // namespace dominant_plane_detection
