// Offline detection: depth images in, planes.csv, masks and overlays out.

#include <unistd.h>

#include <boost/timer/progress_display.hpp>
#include <chrono>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "dominant_plane_detection/dominant_plane_detector.h"
#include "inputs.h"
#include "result_writer.h"
#include "source_arguments.h"
#include "tool_main.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDescription =
    "Finds the dominant plane in depth images and writes, into the output folder, planes.csv (one\n"
    "row an image), masks/ (255 = ground) and overlays/ (the ground painted black); with\n"
    "--set max_planes=8 also planes_more.csv (walls, tables, steps and ramps, a row each).\n\n"
    "The normal points from the plane to the camera and the distance is the camera's height, both\n"
    "in the optical frame (x right, y down, z forward): normal . r + distance = 0.\n\n"
    "Examples:\n"
    "  detect_planes drive.bag --output result\n"
    "  detect_planes depth/ --camera 525,525,319.5,239.5 --output result\n"
    "  detect_planes depth/ --camera-info kinect.yaml --depth-scale 5000 --range 0.3,6 --output "
    "r\n";

struct Options {
  SourceArguments source;
  std::string output;
  bool labels = false;
};

void declare(CLI::App& app, Options& options) {
  declareSource(app, options.source, true);
  app.add_option("--output", options.output, "folder for the results, made where it is missing")
      ->required()
      ->type_name("DIR");
  app.add_flag(
      "--labels", options.labels,
      "also writes labels/: 0 unknown, 1 ground, 2 obstacle, 3 drop-off, 4 missing ground");
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
  DominantPlaneDetector detector(options.source.readParameters());
  const Inputs inputs = openInputs(options.source.inputs, options.source.readSourceOptions());
  ResultWriter writer(options.output, options.labels, detector.parameters().max_planes > 1);
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
