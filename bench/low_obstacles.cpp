// Prints how low an obstacle may be and still be seen: boxes of 12 cm stood into real images, at
// several heights and distances, and beside it what is called obstacle or drop-off on the floors of
// the same images without them. For the detector, and for a fixed height over its plane.

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "support/floor_objects.h"
#include "support/recordings.h"
#include "tools/sensor_profiles.h"
#include "tools/yaml_files.h"

namespace dominant_plane_detection {
namespace {

constexpr double kWidth = 0.12;                                             // [m] of the boxes
constexpr double kHeights[] = {0.01, 0.02, 0.03, 0.05};                     // [m]
constexpr double kDistances[] = {0.7, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5};  // [m]
constexpr std::size_t kCells = std::size(kDistances) - 1;
constexpr int kTries = 100000;  // [#] a cell
constexpr int kPiece = 30;      // [px] a false piece has at least

/// [-] `Label` of each pixel.
using Labels = std::vector<std::uint8_t>;

bool isObstacle(std::uint8_t label) { return label == static_cast<std::uint8_t>(Label::kObstacle); }
bool isGround(std::uint8_t label) { return label == static_cast<std::uint8_t>(Label::kGround); }
bool isDropOff(std::uint8_t label) { return label == static_cast<std::uint8_t>(Label::kDropOff); }

/// Half of an object's readings are obstacle, and a quarter ground at most.
bool isFound(const Labels& labels, const std::vector<int>& pixels) {
  std::size_t obstacle = 0, ground = 0;
  for (const int pixel : pixels) {
    obstacle += isObstacle(labels[static_cast<std::size_t>(pixel)]) ? 1 : 0;
    ground += isGround(labels[static_cast<std::size_t>(pixel)]) ? 1 : 0;
  }
  return 2 * obstacle >= pixels.size() && 4 * ground <= pixels.size();
}

struct FalseAlarms {
  int images = 0;
  int pieces = 0;            ///< [#] connected floor pixels, at least kPiece of them
  std::size_t pixels = 0;    ///< [#] of floor that is called something else
  std::size_t readings = 0;  ///< [#] of floor
};

void count(const Labels& labels, const ReferenceImage& image, const cv::Mat& floor,
           FalseAlarms& alarms) {
  cv::Mat wrong = cv::Mat::zeros(floor.size(), CV_8U);
  for (int i = 0; i < floor.rows * floor.cols; ++i) {
    if (floor.data[i] != 255 || image.depth.at<std::uint16_t>(i / floor.cols, i % floor.cols) == 0)
      continue;
    ++alarms.readings;
    const std::uint8_t label = labels[static_cast<std::size_t>(i)];
    if (!isObstacle(label) && !isDropOff(label)) continue;
    ++alarms.pixels;
    wrong.data[i] = 255;
  }
  cv::Mat components, stats, centres;
  const int number = cv::connectedComponentsWithStats(wrong, components, stats, centres, 8);
  for (int i = 1; i < number; ++i) alarms.pieces += stats.at<int>(i, cv::CC_STAT_AREA) >= kPiece;
  ++alarms.images;
}

/// Writes what an image's floor is called: obstacle red, drop-off blue, unknown dark; not floor
/// black.
void draw(const std::string& file, const Labels& labels, const cv::Mat& floor) {
  cv::Mat picture = cv::Mat::zeros(floor.size(), CV_8UC3);
  for (int i = 0; i < floor.rows * floor.cols; ++i) {
    if (floor.data[i] != 255) continue;
    const std::uint8_t label = labels[static_cast<std::size_t>(i)];
    picture.at<cv::Vec3b>(i / floor.cols, i % floor.cols) =
        isObstacle(label)  ? cv::Vec3b(0, 0, 255)
        : isDropOff(label) ? cv::Vec3b(255, 0, 0)
        : isGround(label)  ? cv::Vec3b(160, 160, 160)
                           : cv::Vec3b(60, 60, 60);
  }
  cv::imwrite(file, picture);
}

struct Options {
  int boxes = 200;  ///< [#] a cell
  std::string pictures;
  std::vector<std::string> settings;
};

/// Stands boxes of a height at a distance.
/// @param visit gets each image with a box.
/// @return how many there were: where there is no room for them, fewer than asked for.
int standBoxes(const ReferenceSet& set, const std::vector<FloorObjects>& floors, double height,
               std::size_t cell, int asked, const std::function<void(const StoodIn&)>& visit) {
  std::mt19937 random(static_cast<unsigned>(cell) + 100U * static_cast<unsigned>(1e3 * height));
  std::uniform_int_distribution<std::size_t> any_image(0, floors.size() - 1);
  std::uniform_int_distribution<int> any_column(0, set.camera.width - 1);
  std::uniform_int_distribution<int> any_row(0, set.camera.height - 1);
  std::uniform_real_distribution<double> any_turn(0.0, 1.5707963);
  int boxes = 0;
  for (int i = 0; i < kTries && boxes < asked; ++i) {
    const FloorObjects& floor = floors[any_image(random)];
    const int u = any_column(random), v = any_row(random);
    const double turn = any_turn(random);
    const double z = floor.planeDepth(u, v);
    if (z < kDistances[cell] || z >= kDistances[cell + 1]) continue;
    TriangleMesh box = boxMesh({kWidth, kWidth, height});
    box.transform(Eigen::Isometry3d(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ())));
    const auto stood = floor.stand(box, u, v);
    if (!stood) continue;
    ++boxes;
    visit(*stood);
  }
  return boxes;
}

/// Labels by a fixed height over the detector's plane.
Labels labelsByHeight(const ReferenceSet& set, const DepthView& view, const Detection& detection,
                      double threshold) {
  Labels labels(detection.labels.size(), static_cast<std::uint8_t>(Label::kUnknown));
  for (int v = 0; v < view.height; ++v) {
    for (int u = 0; u < view.width; ++u) {
      const Eigen::Vector3d point = set.point(view, u, v);
      if (point.z() < set.range_min || point.z() > set.range_max) continue;
      const double height = detection.height(point);
      const Label label = height > threshold    ? Label::kObstacle
                          : height < -threshold ? Label::kDropOff
                                                : Label::kGround;
      labels[static_cast<std::size_t>(v * view.width + u)] = static_cast<std::uint8_t>(label);
    }
  }
  return labels;
}

struct Contestant {
  std::string name;
  std::function<Labels(const DepthView&, const Detection&)> labels;
  FalseAlarms alarms;
  std::array<std::array<double, kCells>, std::size(kHeights)> found{};  ///< [-] NaN without room
};

void print(const ReferenceSet& set, const Contestant& contestant) {
  const FalseAlarms& alarms = contestant.alarms;
  std::printf("%s, %s: %.2f false pieces an image, %.2f %% of the floor\n", set.name.c_str(),
              contestant.name.c_str(), static_cast<double>(alarms.pieces) / alarms.images,
              100.0 * static_cast<double>(alarms.pixels) / static_cast<double>(alarms.readings));
  for (std::size_t i = 0; i < std::size(kHeights); ++i) {
    std::printf("  %2.0f mm", 1e3 * kHeights[i]);
    for (const double share : contestant.found[i]) std::printf("  %4.2f", share);
    std::printf("\n");
  }
}

void evaluate(const ReferenceSet& set, const std::string& sensor, const Options& options) {
  Parameters parameters;
  parameters.range_min = set.range_min;
  parameters.range_max = set.range_max;
  loadParameters(findSensorProfile(sensor), parameters);
  for (const std::string& setting : options.settings) {
    const std::size_t equals = setting.find('=');
    setParameter(parameters, setting.substr(0, equals), setting.substr(equals + 1));
  }
  DominantPlaneDetector detector(parameters);
  std::vector<Contestant> contestants;
  contestants.push_back(
      {"the detector", [](const auto&, const Detection& d) { return d.labels; }, {}, {}});
  for (const int mm : {15, 30}) {
    const auto labels = [&set, mm](const DepthView& view, const Detection& detection) {
      return labelsByHeight(set, view, detection, 1e-3 * mm);
    };
    contestants.push_back({std::to_string(mm) + " mm over its plane", labels, {}, {}});
  }
  std::vector<FloorObjects> floors;
  for (const ReferenceImage& image : set.images) {
    floors.emplace_back(set, image);
    const DepthView view = set.view(image);
    const Detection& detection = detector.detect(view, set.camera);
    for (Contestant& each : contestants) {
      count(each.labels(view, detection), image, floors.back().floor(), each.alarms);
    }
    if (options.pictures.empty()) continue;
    draw(options.pictures + "/" + set.name + "_" + image.name + ".png", detection.labels,
         floors.back().floor());
  }
  for (std::size_t i = 0; i < std::size(kHeights); ++i) {
    for (std::size_t cell = 0; cell < kCells; ++cell) {
      const int boxes =
          standBoxes(set, floors, kHeights[i], cell, options.boxes, [&](const StoodIn& stood) {
            const DepthView view(stood.depth.ptr<std::uint16_t>(), stood.depth.cols,
                                 stood.depth.rows, set.metres_per_unit);
            const Detection& detection = detector.detect(view, set.camera);
            for (Contestant& each : contestants) {
              each.found[i][cell] += isFound(each.labels(view, detection), stood.pixels) ? 1 : 0;
            }
          });
      const double room = boxes < options.boxes ? std::nan("") : boxes;
      for (Contestant& each : contestants) each.found[i][cell] /= room;
    }
  }
  for (const Contestant& each : contestants) print(set, each);
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  namespace dpd = dominant_plane_detection;
  CLI::App app("How low an obstacle may be", "low_obstacles");
  dpd::Options options;
  app.add_option("--boxes", options.boxes, "of each height at each distance")
      ->capture_default_str();
  app.add_option("--pictures", options.pictures, "folder for pictures of the floors");
  app.add_option("--set", options.settings, "NAME=VALUE, a parameter; may be repeated");
  CLI11_PARSE(app, argc, argv);
  std::printf("boxes of 12 cm found, by distance [m]:");
  for (std::size_t i = 0; i < dpd::kCells; ++i) {
    std::printf(" %g-%g", dpd::kDistances[i], dpd::kDistances[i + 1]);
  }
  std::printf("\n");
  const std::pair<dpd::ReferenceSet, const char*> recordings[] = {
      {dpd::loadRobotLab(), "realsense_d4xx"}, {dpd::loadCabinet(), "xtion"}};
  for (const auto& [set, sensor] : recordings) {
    if (set.images.empty()) {
      std::fprintf(stderr, "no recordings in %s\n", dpd::recordingsFolder().c_str());
      return 1;
    }
    dpd::evaluate(set, sensor, options);
  }
}
