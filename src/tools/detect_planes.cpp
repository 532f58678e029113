// Offline detection: depth images in, planes.csv, masks and overlays out.

#include <unistd.h>

#include <boost/timer/progress_display.hpp>
#include <chrono>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "inputs.h"
#include "result_writer.h"
#include "tool_main.h"
#include "yaml_files.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDescription =
    "Finds the dominant plane in depth images and writes, into the output folder, planes.csv (one\n"
    "row an image), masks/ (255 = ground) and overlays/ (the ground painted black).\n\n"
    "The normal points from the plane to the camera and the distance is the camera's height, both\n"
    "in the optical frame (x right, y down, z forward): normal . r + distance = 0.\n\n"
    "Examples:\n"
    "  detect_planes drive.bag --output result\n"
    "  detect_planes depth/ --camera 525,525,319.5,239.5 --output result\n"
    "  detect_planes depth/ --camera-info kinect.yaml --depth-scale 5000 --range 0.3,6 --output "
    "r\n";

struct Options {
  std::vector<std::string> inputs;
  std::string output;
  std::string topic;
  std::vector<double> camera;
  std::string camera_info;
  double depth_scale = 1000.0;
  std::string params;
  std::vector<std::string> settings;
  std::vector<double> range;
  std::string algorithm;
};

void declare(CLI::App& app, Options& options) {
  app.add_option("inputs", options.inputs, "PNG files, folders of PNG files, bags, .oni recordings")
      ->required()
      ->type_name("INPUT");
  app.add_option("--output", options.output, "folder for the results, made where it is missing")
      ->required()
      ->type_name("DIR");
  app.add_option("--topic", options.topic, "depth topic, for a bag that has several");
  app.add_option("--camera", options.camera, "pinhole of PNG images [px]; overrides a bag's")
      ->delimiter(',')
      ->expected(4)
      ->type_name("FX,FY,CX,CY");
  app.add_option("--camera-info", options.camera_info, "calibration file instead of --camera")
      ->type_name("FILE")
      ->excludes("--camera");
  app.add_option("--depth-scale", options.depth_scale, "units per metre of 16-bit PNG images")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--params", options.params, "detection parameters, the nodelet's YAML")
      ->type_name("FILE");
  app.add_option("--set", options.settings, "one detection parameter; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  app.add_option("--range", options.range, "trusted depths [m]")
      ->delimiter(',')
      ->expected(2)
      ->type_name("MIN,MAX");
  app.add_option("--algorithm", options.algorithm, "grid (default) or kdtree")
      ->check(CLI::IsMember({"grid", "kdtree"}));
}

/// Later ones win: file, --set, --range, --algorithm.
Parameters readParameters(const Options& options) {
  Parameters parameters;
  if (!options.params.empty()) loadParameters(options.params, parameters);
  for (const std::string& setting : options.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument("--set: expected NAME=VALUE, got '" + setting + "'");
    }
    setParameter(parameters, setting.substr(0, equals), setting.substr(equals + 1));
  }
  if (!options.range.empty()) {
    parameters.range_min = options.range[0];
    parameters.range_max = options.range[1];
  }
  if (!options.algorithm.empty()) setParameter(parameters, "algorithm", options.algorithm);
  return parameters;
}

SourceOptions readSourceOptions(const Options& options) {
  SourceOptions source;
  source.units_per_metre = options.depth_scale;
  source.topic = options.topic;
  if (!options.camera_info.empty()) {
    source.camera = loadCamera(options.camera_info);
  } else if (!options.camera.empty()) {
    CameraModel camera;  // takes the size of each image
    camera.fx = options.camera[0];
    camera.fy = options.camera[1];
    camera.cx = options.camera[2];
    camera.cy = options.camera[3];
    source.camera = camera;
  }
  return source;
}

/// Prints errors at once, or after the progress bar where there is one, and remembers that there
/// were any.
class Report {
 public:
  explicit Report(std::size_t frames) {
    if (isatty(STDERR_FILENO) != 0 && frames > 1) progress_.emplace(frames, std::cerr);
  }
  ~Report() {
    for (const std::string& error : late_errors_) std::cerr << "detect_planes: " << error << '\n';
  }
  Report(const Report&) = delete;
  Report& operator=(const Report&) = delete;

  void error(const std::string& text) {
    failed_ = true;
    if (progress_) {
      late_errors_.push_back(text);
    } else {
      std::cerr << "detect_planes: " << text << '\n';
    }
  }
  void frameDone() {
    if (progress_) ++*progress_;
  }
  bool failed() const { return failed_; }

 private:
  std::optional<boost::timer::progress_display> progress_;
  std::vector<std::string> late_errors_;
  bool failed_ = false;
};

void process(FrameSource& source, DominantPlaneDetector& detector, ResultWriter& writer,
             Report& report) {
  while (true) {
    try {
      const std::optional<Frame> frame = source.next();
      if (!frame) return;
      const auto start = std::chrono::steady_clock::now();
      const Detection& detection = detector.detect(frame->depth, frame->camera);
      const std::chrono::duration<double, std::milli> time =
          std::chrono::steady_clock::now() - start;
      writer.write(*frame, detection, time.count());
    } catch (const UnreadableFrame& error) {
      report.error(error.what());
    }
    report.frameDone();
  }
}

int run(const Options& options) {
  DominantPlaneDetector detector(readParameters(options));
  const Inputs inputs = openInputs(options.inputs, readSourceOptions(options));
  ResultWriter writer(options.output);
  bool failed = false;
  {
    Report report(inputs.frames());
    for (const std::string& error : inputs.errors) report.error(error);
    for (const auto& source : inputs.sources) process(*source, detector, writer, report);
    failed = report.failed();
  }
  std::cout << writer.summary() << '\n';
  return failed ? 1 : 0;
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  CLI::App app(dominant_plane_detection::kDescription, "detect_planes");
  dominant_plane_detection::Options options;
  dominant_plane_detection::declare(app, options);
  return dominant_plane_detection::runTool(app, argc, argv,
                                           [&] { return dominant_plane_detection::run(options); });
}
