// The stages of the detector one by one, and the paper's own claims about its cost.

#include <benchmark/benchmark.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "core/disparity_table.h"
#include "core/grid_search.h"
#include "core/ground_segmentation.h"
#include "core/ray_table.h"
#include "core/tile_moments.h"
#include "dominant_plane_detection/depth_correction.h"
#include "dominant_plane_detection/dominant_plane_detector.h"
#include "navigation/ground_scan.h"
#include "navigation/local_map.h"
#include "navigation/obstacle_boxes.h"
#include "reference_sets.h"

namespace dominant_plane_detection {
namespace {

/// The first random scene.
const ReferenceSet& scene() {
  static const ReferenceSet set = loadRandomScenes(1);
  return set;
}
DepthView depth() { return scene().view(scene().images.front()); }
RayTable rays() {
  RayTable table;
  table.build(scene().camera);
  return table;
}
PlaneSelection selection() {
  return PlaneSelection({-Eigen::Vector3d::UnitY(), 1.05, 0.0, 10.0, 1000});
}

void tileMoments(benchmark::State& state) {
  const RayTable table = rays();
  TileMoments tiles;
  for (auto _ : state) computeTileMoments(depth(), table, 0.5F, 4.0F, tiles);
}
BENCHMARK(tileMoments)->Unit(benchmark::kMicrosecond);

void gridSearch(benchmark::State& state) {
  TileMoments tiles;
  computeTileMoments(depth(), rays(), 0.5F, 4.0F, tiles);
  GridSearch search;
  for (auto _ : state) {
    PlaneSelection result = selection();
    Effort effort;
    search.run({tiles, scene().camera, 400}, Parameters(), std::nullopt, result, effort);
    benchmark::DoNotOptimize(effort);
  }
}
BENCHMARK(gridSearch)->Unit(benchmark::kMicrosecond);

void labels(benchmark::State& state) {
  const RayTable table = rays();
  const ReferenceImage& image = scene().images.front();
  const Parameters p;
  GroundSegmentation segmentation;
  const std::vector<std::uint8_t> everywhere(80 * 60, 1), nowhere(80 * 60, 0);
  std::vector<std::uint8_t> labels;
  const DepthView view = depth();
  for (auto _ : state) {
    benchmark::DoNotOptimize(segmentation.label(
        {view, table, {view.metres_per_unit, 0.5F, 4.0F}}, image.up, image.height,
        {p.noise, p.ground_band, {}}, {everywhere, nowhere}, labels));
  }
}
BENCHMARK(labels)->Unit(benchmark::kMicrosecond);

/// What can be switched on and off, by what the whole detector takes with it.
void detectorWith(benchmark::State& state, const Parameters& parameters) {
  DominantPlaneDetector detector(parameters);
  const DepthView view = depth();
  for (auto _ : state) benchmark::DoNotOptimize(detector.detect(view, scene().camera).inliers);
}
Parameters withAll(bool covariance, bool missing_ground, int max_planes) {
  Parameters parameters;
  parameters.covariance = covariance;
  parameters.missing_ground = missing_ground;
  parameters.max_planes = max_planes;
  return parameters;
}
BENCHMARK_CAPTURE(detectorWith, nothing_more, withAll(false, false, 1))
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(detectorWith, covariance, withAll(true, false, 1))->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(detectorWith, missing_ground, withAll(false, true, 1))
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(detectorWith, further_planes, withAll(false, false, 8))
    ->Unit(benchmark::kMicrosecond);

/// What navigation takes, of a detection that is there.
struct Seen {
  RayTable table = rays();
  DepthView view = depth();
  DominantPlaneDetector detector;
  const Detection& detection = detector.detect(view, scene().camera);
};

void groundScan(benchmark::State& state) {
  Seen seen;
  GroundScanner scanner;
  for (auto _ : state) {
    benchmark::DoNotOptimize(scanner.scan(seen.view, seen.table, seen.detection, {}).range_max);
  }
}
BENCHMARK(groundScan)->Unit(benchmark::kMicrosecond);

void localMap(benchmark::State& state) {
  Seen seen;
  LocalMap map(0.05, 8.0, 10.0);
  double stamp = 0.0;
  for (auto _ : state) {
    map.add(stamp += 0.03, seen.view, seen.table, seen.detection, {},
            Eigen::Isometry2d::Identity());
  }
}
BENCHMARK(localMap)->Unit(benchmark::kMicrosecond);

void obstacleBoxes(benchmark::State& state) {
  Seen seen;
  ObstacleBoxes boxes;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        boxes.find(seen.view, seen.table, seen.detection, {}, Parameters().local_error).size());
  }
}
BENCHMARK(obstacleBoxes)->Unit(benchmark::kMicrosecond);

void depthCorrection(benchmark::State& state) {
  DepthCorrection correction({2, 2, {0.001, -0.001, 0.002, 0.0}});
  const DepthView view = depth();
  for (auto _ : state) benchmark::DoNotOptimize(correction.correct(view).data);
}
BENCHMARK(depthCorrection)->Unit(benchmark::kMicrosecond);

/// An image of raw disparity as somebody sees it: neighbours differ by little.
std::vector<std::uint16_t> disparity() {
  std::mt19937 generator(1);
  std::uniform_int_distribution<int> noise(-3, 3);
  std::vector<std::uint16_t> raw;
  for (int i = 0; i < 640 * 480; ++i) {
    raw.push_back(static_cast<std::uint16_t>(600 + i / 1000 + noise(generator)));
  }
  return raw;
}

/// Raw disparity to millimetres, by the table and by Eq. 1 for each pixel.
void disparityTable(benchmark::State& state) {
  const DisparityTable table(DepthCalibration::paper());
  const std::vector<std::uint16_t> raw = disparity();
  std::vector<std::uint16_t> depth(raw.size());
  for (auto _ : state) {
    table.apply(raw.data(), raw.size(), depth.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(disparityTable)->Unit(benchmark::kMicrosecond);

void disparityFormula(benchmark::State& state) {
  const DepthCalibration calibration = DepthCalibration::paper();
  const std::vector<std::uint16_t> raw = disparity();
  std::vector<std::uint16_t> depth(raw.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < raw.size(); ++i) {
      depth[i] = static_cast<std::uint16_t>(1000.0 * calibration.distance(raw[i]) + 0.5);
    }
    benchmark::ClobberMemory();
  }
}
BENCHMARK(disparityFormula)->Unit(benchmark::kMicrosecond);

void wholeDetector(benchmark::State& state, Algorithm algorithm, int subsampling) {
  Parameters parameters;
  parameters.algorithm = algorithm;
  parameters.subsampling = subsampling;
  DominantPlaneDetector detector(parameters);
  for (auto _ : state) {
    benchmark::DoNotOptimize(detector.detect(depth(), scene().camera).distance);
  }
}
BENCHMARK_CAPTURE(wholeDetector, grid, Algorithm::kGrid, 1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wholeDetector, kdtree_n1, Algorithm::kKdtree, 1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(wholeDetector, kdtree_n2, Algorithm::kKdtree, 2)->Unit(benchmark::kMillisecond);

/// 2,000 points joining a plane one by one, with its mean square error known after each.
std::vector<Eigen::Vector3d> joiningPoints() {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, 0.005);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 2000; ++i)
    points.emplace_back(spread(generator), 1.0 + noise(generator), 2.0 + spread(generator));
  return points;
}

void equation10(benchmark::State& state) {
  const auto points = joiningPoints();
  for (auto _ : state) {
    PlaneMoments moments;
    for (const auto& r : points) {
      moments.add(r);
      benchmark::DoNotOptimize(moments.fit());
    }
  }
}
BENCHMARK(equation10)->Unit(benchmark::kMillisecond);

void recomputing(benchmark::State& state) {
  const auto points = joiningPoints();
  for (auto _ : state) {
    for (std::size_t k = 1; k <= points.size(); ++k) {
      PlaneMoments moments;
      for (std::size_t i = 0; i < k; ++i) moments.add(points[i]);  // Eq. 5, 6 over all again
      benchmark::DoNotOptimize(moments.fit());
    }
  }
}
BENCHMARK(recomputing)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dominant_plane_detection
