// Prints how well both algorithms do on the real recordings and on random scenes: agreement with
// reference planes that are fits like ours, and beside it what does not depend on such fits, the
// exact truth of scenes and the difference between the halves of each image.

#include <chrono>
#include <cstdio>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "reference_sets.h"
#include "support/halves.h"
#include "support/noise_figures.h"
#include "support/scoring.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegrees = 57.29577951308232;

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
  std::printf("%s: %s (IoU between the two: median %.4f)\n", set.name.c_str(),
              set.exact ? "against the exact truth" : "agreement with least-squares planes",
              quantile(overlaps, 0.5));
  print("grid", summarize(grid.scores));
  print("kdtree", summarize(kdtree.scores));
}

void printHalves(const ReferenceSet& set, const char* name, Algorithm algorithm) {
  const HalvesSummary halves = compareHalves(set, algorithm);
  std::printf("  %-28s %-7s %4zu/%-4zu  %.3f  %6.2f\n", set.name.c_str(), name, halves.found,
              halves.images, kDegrees * halves.angle, 1e3 * halves.height);
}

/// What the floor's readings themselves allow.
void printNoise(const ReferenceSet& set) {
  std::printf("  %s\n", set.name.c_str());
  for (const NoiseFigures& figures : noiseFigures(set)) {
    if (figures.pixels < 1000) continue;
    std::printf("    %.1f to %.1f m  %6.2f  %5.2f  %6.2f\n", figures.nearest, figures.farthest,
                1e3 * figures.height, 1e3 * figures.neighbour, 1e3 * figures.local);
  }
}

}  // namespace
}  // namespace dominant_plane_detection

int main() {
  namespace dpd = dominant_plane_detection;
  const auto sets = dpd::loadAllSets(60);
  std::printf(
      "          right/all   IoU  p10        plain  p10        deg  p90       mm   p90         "
      "ms\n");
  for (const auto& set : sets) dpd::evaluate(set);
  std::printf("\nleft against right half of each image, medians    both    deg      mm\n");
  for (const auto& set : sets) {
    dpd::printHalves(set, "grid", dpd::Algorithm::kGrid);
    dpd::printHalves(set, "kdtree", dpd::Algorithm::kKdtree);
  }
  std::printf("\nheight of floor readings over their best plane [mm]: rms, neighbours, local\n");
  for (const auto& set : sets) dpd::printNoise(set);
}
