#include "support/halves.h"

#include <algorithm>
#include <cmath>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/mahalanobis.h"
#include "support/scoring.h"

namespace dominant_plane_detection {
namespace {

/// @return a copy in which only the columns from `begin` to before `end` have readings.
ReferenceImage onlyColumns(const ReferenceImage& image, int begin, int end) {
  // A matrix of its own: zeros assigned to the copy would be written into the original's memory.
  const cv::Mat depth = cv::Mat::zeros(image.depth.size(), image.depth.type());
  image.depth.colRange(begin, end).copyTo(depth.colRange(begin, end));
  ReferenceImage part = image;
  part.depth = depth;
  return part;
}

}  // namespace

HalfDifference compareHalves(const ReferenceSet& set, const ReferenceImage& image,
                             const Parameters& parameters) {
  const int width = image.depth.cols;
  const ReferenceImage left_half = onlyColumns(image, 0, width / 2);
  const ReferenceImage right_half = onlyColumns(image, width / 2, width);
  DominantPlaneDetector left_detector(parameters), right_detector(parameters);
  const Detection& left = left_detector.detect(set.view(left_half), set.camera);
  const Detection& right = right_detector.detect(set.view(right_half), set.camera);
  HalfDifference difference;
  difference.found = left.found() && right.found();
  if (!difference.found) return difference;
  difference.angle = std::acos(std::clamp(left.normal.dot(right.normal), -1.0, 1.0));
  difference.height = std::abs(left.distance - right.distance);
  difference.square =
      squaredMahalanobis(left.covariance + right.covariance,
                         planeDifference(left.normal, left.distance, right.normal, right.distance));
  return difference;
}

HalvesSummary compareHalves(const ReferenceSet& set, Algorithm algorithm) {
  Parameters parameters;
  parameters.algorithm = algorithm;
  parameters.range_min = set.range_min;
  parameters.range_max = set.range_max;
  HalvesSummary summary;
  summary.images = set.images.size();
  std::vector<double> angles, heights;
  for (const ReferenceImage& image : set.images) {
    const HalfDifference difference = compareHalves(set, image, parameters);
    if (!difference.found) continue;
    angles.push_back(difference.angle);
    heights.push_back(difference.height);
  }
  summary.found = angles.size();
  summary.angle = quantile(angles, 0.5);
  summary.height = quantile(heights, 0.5);
  return summary;
}

}  // namespace dominant_plane_detection
