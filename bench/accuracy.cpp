// Prints the accuracy of both algorithms on the real recordings and on random scenes.

#include <chrono>
#include <cstdio>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "reference_sets.h"
#include "support/scoring.h"

namespace dominant_plane_detection {
namespace {

struct Result {
  std::vector<Score> scores;
  std::vector<std::vector<std::uint8_t>> labels;
};

Result run(const ReferenceSet& set, Algorithm algorithm) {
  Parameters parameters;
  parameters.algorithm = algorithm;
  parameters.range_min = set.range_min;
  parameters.range_max = set.range_max;
  DominantPlaneDetector detector(parameters);
  detector.detect(set.view(set.images.front()), set.camera);  // warm
  Result result;
  for (const ReferenceImage& image : set.images) {
    const auto start = std::chrono::steady_clock::now();
    const Detection& detection = detector.detect(set.view(image), set.camera);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    result.scores.push_back(score(detection, set, image));
    result.scores.back().ms = time.count();
    result.labels.push_back(detection.labels);
  }
  return result;
}

void print(const char* algorithm, const Summary& s) {
  constexpr double kDegrees = 57.29577951308232;
  std::printf("  %-7s %4zu/%-4zu  %.4f %.4f   %.4f %.4f   %.3f %.3f   %5.2f %5.2f   %8.2f\n",
              algorithm, s.images - s.failures, s.images, s.iou_median, s.iou_p10,
              s.plain_iou_median, s.plain_iou_p10, kDegrees * s.angle_median,
              kDegrees * s.angle_p90, 1e3 * s.height_median, 1e3 * s.height_p90, s.ms_median);
}

void evaluate(const ReferenceSet& set) {
  const Result grid = run(set, Algorithm::kGrid);
  const Result kdtree = run(set, Algorithm::kKdtree);
  std::vector<double> overlaps;
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    overlaps.push_back(groundOverlap(grid.labels[i], kdtree.labels[i]));
  }
  std::printf("%s (IoU between the two: median %.4f)\n", set.name.c_str(), quantile(overlaps, 0.5));
  print("grid", summarize(grid.scores));
  print("kdtree", summarize(kdtree.scores));
}

}  // namespace
}  // namespace dominant_plane_detection

int main() {
  std::printf(
      "          right/all   IoU  p10        plain  p10        deg  p90       mm   p90         "
      "ms\n");
  for (const auto& set : dominant_plane_detection::loadAllSets(60)) {
    dominant_plane_detection::evaluate(set);
  }
}
