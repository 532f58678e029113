// Calibrates the raw disparity of a structured-light sensor, as in Section II of the paper:
// measured pairs of raw value and distance in, the constants of a form with their errors out.

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <cstdio>
#include <iostream>
#include <sstream>

#include "calibration/depth_calibration_file.h"
#include "calibration/depth_fit.h"
#include "calibration/fit_plot.h"
#include "calibration/pair_file.h"
#include "calibration/wall_reading.h"
#include "inputs.h"
#include "live_disparity.h"
#include "tool_main.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDescription =
    "Finds out what distance a raw depth value stands for.\n\n"
    "  1. Point the camera at a flat wall and measure the distance with a tape, along the optical\n"
    "     axis. Do so at ten or more distances over the range that you use:\n"
    "       calibrate_depth measure --device '#1' --output pairs.csv\n"
    "     or from recordings of raw disparity, one for each distance:\n"
    "       calibrate_depth measure wall.bag --topic /camera/depth/disparity_raw --distance 1.25 "
    "\\\n"
    "                       --output pairs.csv\n"
    "  2. Fit:\n"
    "       calibrate_depth fit pairs.csv --output kinect.yaml --plot fit.png\n"
    "  3. Use it: camera.launch raw_disparity:=true depth_calibration:=/path/of/kinect.yaml\n";

struct FitCommand {
  std::string pairs;
  std::string form = "reciprocal";
  std::string output;
  std::string plot;
  DepthFitOptions options;
};

struct MeasureCommand {
  std::vector<std::string> inputs;
  std::string topic;
  std::string device;
  double distance = 0.0;
  int frames = 30;
  std::string output;
};

void declare(CLI::App& app, FitCommand& command) {
  app.add_option("pairs", command.pairs,
                 "CSV file with the columns raw,distance (and sigma, the distance's own standard "
                 "deviation), distances in metres")
      ->required()
      ->type_name("PAIRS.csv");
  app.add_option("--form", command.form,
                 "reciprocal: Z = 1 / (a + b D); exponential: Z = a exp(b D) + c exp(d D), Eq. 1")
      ->check(CLI::IsMember({"reciprocal", "exponential"}))
      ->capture_default_str();
  app.add_option("--output", command.output, "calibration file for the driver")
      ->type_name("FILE.yaml");
  app.add_option("--plot", command.plot, "picture of the points, the curve and the residuals")
      ->type_name("FILE.png");
  app.add_option("--distance-error", command.options.distance_sigma,
                 "[m] standard deviation of a measured distance")
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  app.add_option("--raw-error", command.options.raw_sigma,
                 "[-] standard deviation of the raw value of a whole wall, most of it the sensor's "
                 "smooth error")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  app.add_flag("--minimax", command.options.minimax,
               "make the largest error, in standard deviations, as small as can be, instead of the "
               "mean square: for a table without noise");
}

void declare(CLI::App& app, MeasureCommand& command) {
  auto* const inputs =
      app.add_option("inputs", command.inputs,
                     "recordings of raw disparity: 16-bit PNG files, folders of them, bags, .oni")
          ->type_name("INPUT");
  app.add_option("--topic", command.topic, "topic, for a bag that has several");
  app.add_option("--device", command.device,
                 "measure with this camera, as the driver's device_id names it, instead")
      ->excludes(inputs)
      ->type_name("ID");
  app.add_option(
         "--distance", command.distance,
         "[m] from the camera to the wall; asked for again and again without, with --device")
      ->check(CLI::Range(0.1, 20.0));
  app.add_option("--frames", command.frames, "images for each distance, with --device")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--output", command.output, "pairs are added to this CSV file")
      ->required()
      ->type_name("PAIRS.csv");
}

void printConstant(const char* name, double value, double error, const char* unit) {
  std::printf("  %s = %.9g", name, value);
  if (error > 0.0) std::printf(" +- %.2g", error);
  std::printf(" %s\n", unit);
}

void print(const DepthFit& fit) {
  const DepthCalibration& c = fit.calibration;
  const DepthCalibration& e = fit.standard_errors;
  const bool exponential = c.form == DepthCalibration::Form::kExponential;
  std::printf("%s\n", exponential ? "Z = a exp(b D) + c exp(d D)" : "Z = 1 / (a + b D)");
  printConstant("a", c.a, e.a, exponential ? "m" : "1/m");
  printConstant("b", c.b, e.b, exponential ? "" : "1/m");
  if (exponential) {
    printConstant("c", c.c, e.c, "m");
    printConstant("d", c.d, e.d, "");
  }
  if (e.a > 0.0) std::printf("+-: holds the constant in 68 of 100 such fits\n");
  const auto left_out = std::count(fit.outliers.begin(), fit.outliers.end(), true);
  std::printf("residuals: %.1f mm root mean square, %.1f mm at most; %zu pairs, %td left out\n",
              1000.0 * fit.rms, 1000.0 * fit.worst, fit.outliers.size(), left_out);
  constexpr double kPoor = 3.0;
  if (fit.sigmas > kPoor) {
    std::printf("that is %.1f times what tape and sensor explain: try the other form\n",
                fit.sigmas);
  }
}

void printLeftOut(const std::vector<DepthPair>& pairs, const DepthFit& fit) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!fit.outliers[i]) continue;
    std::printf("  left out: raw %g, %g m, off by %.0f mm\n", pairs[i].raw, pairs[i].distance,
                1000.0 * fit.residuals[i]);
  }
}

std::string describe(const FitCommand& command, const std::vector<DepthPair>& pairs) {
  const auto [least, most] =
      std::minmax_element(pairs.begin(), pairs.end(),
                          [](const auto& p, const auto& q) { return p.distance < q.distance; });
  char text[200];
  std::snprintf(text, sizeof(text), "%s fit to %zu pairs from %.2f to %.2f m",
                command.options.minimax ? "minimax" : "least-squares", pairs.size(),
                least->distance, most->distance);
  return text;
}

int runFit(FitCommand command) {
  command.options.form = command.form == "exponential" ? DepthCalibration::Form::kExponential
                                                       : DepthCalibration::Form::kReciprocal;
  const std::vector<DepthPair> pairs = loadPairs(command.pairs);
  DepthFit fit;
  try {
    fit = fitDepth(pairs, command.options);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(command.pairs + ": " + error.what());
  }
  print(fit);
  printLeftOut(pairs, fit);
  if (!command.output.empty()) {
    saveDepthCalibration(command.output,
                         {fit.calibration, fit.standard_errors, describe(command, pairs)});
  }
  if (!command.plot.empty()) plotFit(command.plot, pairs, fit);
  return 0;
}

void record(const WallReading& wall, double distance, const std::string& output) {
  const DepthPair pair{wall.mean(), distance, 0.0};
  appendPair(output, pair);
  std::printf("raw %.3f at %.4f m, from %zu images, added to %s\n", pair.raw, pair.distance,
              wall.images(), output.c_str());
}

int measureRecordings(const MeasureCommand& command) {
  if (command.distance <= 0.0) throw std::runtime_error("--distance METRES is missing");
  SourceOptions options;
  options.topic = command.topic;
  options.raw_disparity = true;
  options.camera.emplace();  // distances along the optical axis need none
  const Inputs inputs = openInputs(command.inputs, options);
  std::string problems;
  for (const std::string& error : inputs.errors) problems += (problems.empty() ? "" : "; ") + error;
  if (!problems.empty()) throw std::runtime_error(problems);
  WallReading wall;
  for (const auto& source : inputs.sources) {
    while (const auto frame = source->next()) wall.add(frame->depth);
  }
  record(wall, command.distance, command.output);
  return 0;
}

int measureLive(const MeasureCommand& command) {
  LiveDisparity camera(command.device);
  const auto measure = [&](double distance) {
    WallReading wall;
    camera.read(command.frames, [&](const DepthView& raw) { wall.add(raw); });
    record(wall, distance, command.output);
  };
  if (command.distance > 0.0) {
    measure(command.distance);
    return 0;
  }
  std::string line;
  for (;;) {
    std::cout << "distance to the wall [m], an empty line ends: " << std::flush;
    if (!std::getline(std::cin, line)) return 0;
    boost::algorithm::trim(line);
    if (line.empty()) return 0;
    std::istringstream number(line);
    double distance = 0.0;
    if (!(number >> distance) || !number.eof() || !(0.1 <= distance && distance <= 20.0)) {
      std::cout << "expected a number from 0.1 to 20, got '" << line << "'\n";
      continue;
    }
    try {
      measure(distance);
    } catch (const std::exception& error) {
      std::cout << error.what() << "; nothing was added\n";
    }
  }
}

int runMeasure(const MeasureCommand& command) {
  if (!command.device.empty()) return measureLive(command);
  if (command.inputs.empty()) {
    throw std::runtime_error("expected recordings, or a camera with --device");
  }
  return measureRecordings(command);
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  using namespace dominant_plane_detection;
  CLI::App app(kDescription, "calibrate_depth");
  app.require_subcommand(1);
  FitCommand fit;
  MeasureCommand measure;
  CLI::App* const fit_app = app.add_subcommand("fit", "constants from measured pairs");
  CLI::App* const measure_app = app.add_subcommand("measure", "a pair from a flat wall");
  declare(*fit_app, fit);
  declare(*measure_app, measure);
  return runTool(app, argc, argv,
                 [&] { return fit_app->parsed() ? runFit(fit) : runMeasure(measure); });
}
