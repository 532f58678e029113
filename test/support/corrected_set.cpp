#include "support/corrected_set.h"

#include <cmath>

#include "calibration/floor_correction.h"
#include "dominant_plane_detection/dominant_plane_detector.h"

namespace dominant_plane_detection {
namespace {

/// @return the image, corrected, in its unit.
cv::Mat corrected(const DepthView& depth, DepthCorrection& correction) {
  const DepthView view = correction.correct(depth);
  cv::Mat pixels(view.height, view.width, CV_16UC1);
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      pixels.at<std::uint16_t>(v, u) =
          static_cast<std::uint16_t>(std::lround(metresAt(view, u, v) / depth.metres_per_unit));
    }
  }
  return pixels;
}

}  // namespace

ReferenceSet correctByFolds(const ReferenceSet& set, const Parameters& parameters) {
  constexpr std::size_t kFolds = 5;
  const std::size_t count = set.images.size();
  ReferenceSet result = set;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    const std::size_t begin = count * fold / kFolds, end = count * (fold + 1) / kFolds;
    FloorCorrection learner(parameters.noise);
    DominantPlaneDetector detector(parameters);
    for (std::size_t i = 0; i < count; ++i) {
      if (i >= begin && i < end) continue;
      const DepthView view = set.view(set.images[i]);
      learner.add(view, set.camera, detector.detect(view, set.camera));
    }
    DepthCorrection correction(learner.learn().grid);
    for (std::size_t i = begin; i < end; ++i) {
      result.images[i].depth = corrected(set.view(set.images[i]), correction);
    }
  }
  return result;
}

}  // namespace dominant_plane_detection
