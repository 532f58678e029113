// Whole detectors on the same images, taking turns in one thread; prints medians and ratios.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/core/utility.hpp>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "other_detectors.h"
#include "reference_sets.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kBaseline = "OpenCV RgbdPlane";

cv::Mat inMetres(const ReferenceSet& set, const ReferenceImage& image) {
  cv::Mat metres;
  image.depth.convertTo(metres, CV_32F, static_cast<double>(set.metres_per_unit));
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  metres.setTo(kNaN, (metres < set.range_min) | (metres > set.range_max));
  return metres;
}

/// One round over the images of a set is one iteration.
void add(const std::string& detector, const ReferenceSet& set,
         const std::function<void(std::size_t)>& detect) {
  benchmark::RegisterBenchmark((detector + "/" + set.name).c_str(), [&set, detect](
                                                                        benchmark::State& state) {
    for (auto _ : state) {
      for (std::size_t i = 0; i < set.images.size(); ++i) detect(i);
    }
    state.counters["images"] = static_cast<double>(set.images.size());
  })->Unit(benchmark::kMillisecond);
}

void addAll(const ReferenceSet& set) {
  const auto images = std::make_shared<std::vector<cv::Mat>>();
  const auto clouds = std::make_shared<std::vector<cv::Mat>>();
  const OpenCvPlane opencv(set.camera);
  for (const ReferenceImage& image : set.images) {
    images->push_back(inMetres(set, image));
    clouds->push_back(opencv.points(images->back()));
  }
  for (const Algorithm algorithm : {Algorithm::kGrid, Algorithm::kKdtree}) {
    Parameters parameters;
    parameters.algorithm = algorithm;
    parameters.range_min = set.range_min;
    parameters.range_max = set.range_max;
    const auto detector = std::make_shared<DominantPlaneDetector>(parameters);
    add(algorithm == Algorithm::kGrid ? "grid" : "kdtree", set, [&set, detector](std::size_t i) {
      benchmark::DoNotOptimize(detector->detect(set.view(set.images[i]), set.camera).distance);
    });
  }
  add(kBaseline, set,
      [opencv, clouds](std::size_t i) { benchmark::DoNotOptimize(opencv.segment((*clouds)[i])); });
  add("OpenCV RgbdPlane with points and normals", set,
      [opencv, images](std::size_t i) { benchmark::DoNotOptimize(opencv.detect((*images)[i])); });
  add("PCL OrganizedMultiPlaneSegmentation", set, [&set, images](std::size_t i) {
    benchmark::DoNotOptimize(detectWithPclOrganized((*images)[i], set.camera));
  });
  add("PCL RANSAC, a quarter of the points", set, [&set, images](std::size_t i) {
    benchmark::DoNotOptimize(detectWithPclRansac((*images)[i], set.camera));
  });
}

/// Collects the medians and prints them as a table at the end.
class TableReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.aggregate_name != "median") continue;
      const std::string& name = run.run_name.function_name;
      const std::size_t slash = name.find('/');
      table_[name.substr(slash + 1)].emplace_back(
          name.substr(0, slash), run.GetAdjustedCPUTime() / run.counters.at("images").value);
    }
  }
  void Finalize() override {
    for (auto& [set, rows] : table_) {
      std::sort(rows.begin(), rows.end(),
                [](const auto& a, const auto& b) { return a.second < b.second; });
      double baseline = 1.0;
      for (const auto& [detector, ms] : rows) baseline = detector == kBaseline ? ms : baseline;
      std::printf("\n%s, single thread\n  %-42s %10s %10s\n", set.c_str(), "detector", "ms/image",
                  "ratio");
      for (const auto& [detector, ms] : rows) {
        std::printf("  %-42s %10.3f %10.3f\n", detector.c_str(), ms, ms / baseline);
      }
    }
  }

 private:
  std::map<std::string, std::vector<std::pair<std::string, double>>> table_;
};

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  using namespace dominant_plane_detection;
  cv::setNumThreads(1);
  static const std::vector<ReferenceSet> sets = loadAllSets(10);
  for (const ReferenceSet& set : sets) addAll(set);
  std::vector<char*> arguments(argv, argv + argc);
  std::string interleave = "--benchmark_enable_random_interleaving=true";
  std::string repetitions = "--benchmark_repetitions=5";
  std::string time = "--benchmark_min_time=0.05";
  arguments.insert(arguments.begin() + 1, {interleave.data(), repetitions.data(), time.data()});
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  TableReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
}
