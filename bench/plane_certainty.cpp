// Prints whether planes are as sure as they say: against the exact truth of scenes with the errors
// of sensors, and, for recordings, the halves of each image against each other.

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "reference_sets.h"
#include "set_parameters.h"
#include "support/halves.h"
#include "support/mahalanobis.h"
#include "support/scoring.h"
#include "tools/inputs.h"
#include "tools/source_arguments.h"
#include "tools/tool_main.h"

namespace dominant_plane_detection {
namespace {

struct Options {
  std::uint32_t scenes = 200;
  std::string sensor;  ///< instead of each set's own
  std::vector<std::string> settings;
};

/// @param own of a set.
std::string sensorOf(const std::string& own, const Options& options) {
  return options.sensor.empty() ? own : options.sensor;
}

void print(const std::string& name, std::vector<double> squares) {
  if (squares.empty()) return;
  std::size_t inside = 0;
  for (const double square : squares) inside += square < kChiSquare95 ? 1 : 0;
  const auto count = static_cast<double>(squares.size());
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  const double largest = *std::max_element(squares.begin(), squares.end());
  std::printf("%-34s %6zu  %6.3f  %8.2f  %8.2f  %6.2f\n", name.c_str(), squares.size(),
              static_cast<double>(inside) / count, sum / count, (sum - largest) / (count - 1.0),
              quantile(squares, 0.5));
}

/// @return [-] squared Mahalanobis distances between planes and the truth.
std::vector<double> againstTruth(const ReferenceSet& set, const Parameters& parameters) {
  DominantPlaneDetector detector(parameters);
  std::vector<double> squares;
  for (const ReferenceImage& image : set.images) {
    const Detection& detection = detector.detect(set.view(image), set.camera);
    // Another plane than the floor is no matter of certainty.
    if (score(detection, set, image).failed()) continue;
    squares.push_back(squaredMahalanobis(
        detection.covariance,
        planeDifference(detection.normal, detection.distance, image.up, image.height)));
  }
  return squares;
}

/// @return [-] the same between the halves of images.
std::vector<double> halfAgainstHalf(const ReferenceSet& set, const Parameters& parameters) {
  std::vector<double> squares;
  for (const ReferenceImage& image : set.images) {
    const HalfDifference halves = compareHalves(set, image, parameters);
    if (halves.found) squares.push_back(halves.square);
  }
  return squares;
}

/// @return the images of a recording, without truth; none where it is missing.
ReferenceSet loadBag(const std::string& name) {
  ReferenceSet set;
  set.name = name;
  const Inputs inputs = openInputs({recordingsFolder() + "/" + name}, {});
  for (const auto& source : inputs.sources) {
    while (const std::optional<Frame> frame = source->next()) {
      ReferenceImage image;
      image.name = frame->name;
      // OpenCV takes no const data; nothing writes to it.
      image.depth = cv::Mat(frame->depth.height, frame->depth.width, CV_16UC1,
                            const_cast<void*>(frame->depth.data), frame->depth.step)
                        .clone();
      set.camera = frame->camera;
      set.images.push_back(image);
    }
  }
  return set;
}

int run(const Options& options) {
  std::printf("squared distances (3 expected)     images  inside      mean   but one  median\n");
  const std::pair<SensorNoise, const char*> sensors[] = {
      {SensorNoise(), "kinect_v1"}, {SensorNoise::realsense(), "realsense_d4xx"}};
  for (const auto& [noise, sensor] : sensors) {
    const ReferenceSet scenes = loadRandomScenes(options.scenes, noise, sensor);
    print(std::string("truth: scenes, ") + sensor,
          againstTruth(scenes, parametersOf(scenes, sensorOf(sensor, options), options.settings)));
  }
  const std::pair<ReferenceSet, const char*> recordings[] = {
      {loadBag("robot_lab.bag"), "realsense_d4xx"},
      {loadCabinet(), "xtion"},
      {loadLowRobot(), "realsense_d4xx"},
      {loadBag("handheld_desk.bag"), "kinect_v1"}};
  std::vector<double> pooled;
  for (const auto& [set, sensor] : recordings) {
    const std::vector<double> squares =
        halfAgainstHalf(set, parametersOf(set, sensorOf(sensor, options), options.settings));
    print("halves: " + set.name, squares);
    pooled.insert(pooled.end(), squares.begin(), squares.end());
  }
  print("halves: all", pooled);
  return 0;
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  CLI::App app("Holds the covariance of planes against their errors.", "plane_certainty");
  dominant_plane_detection::Options options;
  app.add_option("--scenes", options.scenes, "random scenes for each sensor")
      ->capture_default_str();
  app.add_option("--sensor", options.sensor, "profile for all, instead of each set's own");
  app.add_option("--set", options.settings, "NAME=VALUE of a parameter");
  return dominant_plane_detection::runTool(app, argc, argv,
                                           [&] { return dominant_plane_detection::run(options); });
}
