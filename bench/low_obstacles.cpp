// Prints how low an obstacle may be and still be seen: boxes, sills and plates stood into real
// images, of several heights at several distances, and beside it what is called obstacle or
// drop-off on the floors of the same images without them. For the detector, for a fixed height over
// its plane, and for other detectors.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "floor_contestants.h"
#include "set_parameters.h"
#include "support/corrected_set.h"
#include "support/floor_objects.h"
#include "support/recordings.h"
#include "tools/source_arguments.h"
#include "tools/tool_main.h"

namespace dominant_plane_detection {
namespace {

constexpr double kHeights[] = {0.01, 0.02, 0.03, 0.05};                     // [m]
constexpr double kDistances[] = {0.7, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5};  // [m]
constexpr std::size_t kCells = std::size(kDistances) - 1;
constexpr int kTries = 100000;  // [#] a cell
constexpr int kPiece = 30;      // [px] a false piece has at least

/// What is stood on the floor.
struct Kind {
  const char* name;
  double length, width;  ///< [m] away from the camera, across
  bool turned;           ///< about the vertical, by any angle
};
constexpr Kind kKinds[] = {{"box of 12 cm", 0.12, 0.12, true},
                           {"sill of 4 x 60 cm", 0.04, 0.60, false},
                           {"plate of 20 x 30 cm", 0.20, 0.30, true}};

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
  int objects = 200;  ///< [#] a cell
  int smear = 1;      ///< [px]
  bool others = false;
  bool corrected = false;
  std::string pictures;
  std::vector<std::string> settings;
};

/// Stands objects of a kind and a height at a distance.
/// @param visit gets each image with an object.
/// @return how many there were: where there is no room for them, fewer than asked for.
int standObjects(const ReferenceSet& set, const std::vector<FloorObjects>& floors, const Kind& kind,
                 double height, std::size_t cell, const Options& options,
                 const std::function<void(const StoodIn&)>& visit) {
  std::mt19937 random(static_cast<unsigned>(cell) + 100U * static_cast<unsigned>(1e3 * height));
  std::uniform_int_distribution<std::size_t> any_image(0, floors.size() - 1);
  std::uniform_int_distribution<int> any_column(0, set.camera.width - 1);
  std::uniform_int_distribution<int> any_row(0, set.camera.height - 1);
  std::uniform_real_distribution<double> any_turn(0.0, 1.5707963);
  int objects = 0;
  for (int i = 0; i < kTries && objects < options.objects; ++i) {
    const FloorObjects& floor = floors[any_image(random)];
    const int u = any_column(random), v = any_row(random);
    const double turn = any_turn(random);
    const double z = floor.planeDepth(u, v);
    if (z < kDistances[cell] || z >= kDistances[cell + 1]) continue;
    TriangleMesh mesh = boxMesh({kind.length, kind.width, height});
    if (kind.turned) {
      mesh.transform(Eigen::Isometry3d(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ())));
    }
    const auto stood = floor.stand(mesh, u, v, options.smear);
    if (!stood) continue;
    ++objects;
    visit(*stood);
  }
  return objects;
}

/// A row of found shares for each contestant.
void printFound(const ReferenceSet& set, const std::vector<FloorObjects>& floors, const Kind& kind,
                double height, const Options& options, DominantPlaneDetector& detector,
                const std::vector<Contestant>& contestants) {
  std::vector<std::array<double, kCells>> found(contestants.size());
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    std::vector<int> seen(contestants.size(), 0);
    const int objects =
        standObjects(set, floors, kind, height, cell, options, [&](const StoodIn& stood) {
          const DepthView view(stood.depth.ptr<std::uint16_t>(), stood.depth.cols, stood.depth.rows,
                               set.metres_per_unit);
          const Detection& detection = detector.detect(view, set.camera);
          for (std::size_t i = 0; i < contestants.size(); ++i) {
            if (seen[i] >= contestants[i].most) continue;
            ++seen[i];
            found[i][cell] += isFound(contestants[i].labels(view, detection), stood.pixels);
          }
        });
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      found[i][cell] /= objects < options.objects ? std::nan("") : seen[i];
    }
  }
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    std::printf("| %s | %s, %2.0f mm |", contestants[i].name.c_str(), kind.name, 1e3 * height);
    for (const double share : found[i]) std::printf(std::isnan(share) ? " |" : " %.2f |", share);
    std::printf("\n");
  }
  std::fflush(stdout);
}

void evaluate(const ReferenceSet& set, const std::string& sensor, const Options& options) {
  DominantPlaneDetector detector(parametersOf(set, sensor, options.settings));
  const std::vector<Contestant> all = contestants(set, options.others);
  std::vector<FalseAlarms> alarms(all.size());
  std::vector<FloorObjects> floors;
  for (const ReferenceImage& image : set.images) {
    floors.emplace_back(set, image);
    const DepthView view = set.view(image);
    const Detection& detection = detector.detect(view, set.camera);
    for (std::size_t i = 0; i < all.size(); ++i) {
      count(all[i].labels(view, detection), image, floors.back().floor(), alarms[i]);
    }
    if (options.pictures.empty()) continue;
    draw(options.pictures + "/" + set.name + "_" + image.name + ".png", detection.labels,
         floors.back().floor());
  }
  std::printf("\n%s, %s\n\n| | false pieces an image | of the floor |\n|---|---|---|\n",
              set.name.c_str(), sensor.c_str());
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::printf(
        "| %s | %.2f | %.2f %% |\n", all[i].name.c_str(),
        static_cast<double>(alarms[i].pieces) / alarms[i].images,
        100.0 * static_cast<double>(alarms[i].pixels) / static_cast<double>(alarms[i].readings));
  }
  if (options.objects == 0) return;
  std::printf("\n| found | |");
  for (std::size_t i = 0; i < kCells; ++i) {
    std::printf(" %g-%g m |", kDistances[i], kDistances[i + 1]);
  }
  std::printf("\n|---|---|---|---|---|---|---|---|---|\n");
  for (const Kind& kind : kKinds) {
    for (const double height : kHeights) {
      printFound(set, floors, kind, height, options, detector, all);
    }
  }
}

int run(const Options& options) {
  const std::pair<ReferenceSet, const char*> recordings[] = {{loadRobotLab(), "realsense_d4xx"},
                                                             {loadCabinet(), "xtion"}};
  for (const auto& [set, sensor] : recordings) {
    if (set.images.empty()) throw std::runtime_error("no recordings in " + recordingsFolder());
    if (!options.corrected) {
      evaluate(set, sensor, options);
      continue;
    }
    try {
      evaluate(correctByFolds(set, parametersOf(set, sensor, options.settings)), sensor, options);
    } catch (const std::runtime_error& refused) {
      std::printf("\n%s: %s\n", set.name.c_str(), refused.what());
    }
  }
  return 0;
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  namespace dpd = dominant_plane_detection;
  CLI::App app("How low an obstacle may be", "low_obstacles");
  dpd::Options options;
  app.add_option("--objects", options.objects, "of each kind and height at each distance")
      ->capture_default_str();
  app.add_option("--smear", options.smear, "[px] over which the sensor smears their edges")
      ->capture_default_str();
  app.add_flag("--others", options.others, "beside other detectors, on 20 objects each");
  app.add_flag("--corrected", options.corrected,
               "without the fixed error that is learned from the other images");
  app.add_option("--pictures", options.pictures, "folder for pictures of the floors");
  app.add_option("--set", options.settings, "NAME=VALUE, a parameter; may be repeated");
  return dpd::runTool(app, argc, argv, [&] { return dpd::run(options); });
}
