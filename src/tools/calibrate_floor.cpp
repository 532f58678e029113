// A depth camera's fixed error, learned from the floor.

#include <cstdio>
#include <stdexcept>
#include <string>

#include "calibration/depth_correction_file.h"
#include "calibration/floor_correction.h"
#include "dominant_plane_detection/dominant_plane_detector.h"
#include "inputs.h"
#include "source_arguments.h"
#include "tool_main.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDescription =
    "Learns the part of a depth camera's error that is fixed to its pixels, from a recording in\n"
    "which the camera moves over a bare floor, and writes it for --correction and the nodelets'\n"
    "parameter of that name. Writes nothing where that would not help.\n\n"
    "Examples:\n"
    "  calibrate_floor drive.bag --sensor xtion --output my_camera_correction.yaml\n"
    "  detect_planes drive.bag --correction my_camera_correction.yaml --output result\n";

int run(const SourceArguments& arguments, const std::string& output) {
  if (!arguments.correction.empty()) {
    throw std::invalid_argument("--correction: expected images as the camera gives them");
  }
  const Parameters parameters = arguments.readParameters();
  DominantPlaneDetector detector(parameters);
  const Inputs inputs = openInputs(arguments.inputs, arguments.readSourceOptions());
  FloorCorrection correction(parameters.noise);
  const bool all = forEachFrame(inputs, "calibrate_floor", [&](const Frame& frame) {
    correction.add(frame.depth, frame.camera, detector.detect(frame.depth, frame.camera));
  });
  const FloorCorrection::Result learned = correction.learn();
  saveDepthCorrection(output, learned);
  constexpr double kAtTwoMetres = 1e3 * 2.0 * 2.0;  // [mm m] from 1/m
  std::printf(
      "%zu images. On images that it is not learned from, the rms of a twentieth of the image's "
      "width of floor over "
      "its plane, as depth at 2 m: %.1f mm before, %.1f mm after. Written to %s.\n",
      learned.images, kAtTwoMetres * learned.before, kAtTwoMetres * learned.after, output.c_str());
  return all ? 0 : 1;
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  CLI::App app(dominant_plane_detection::kDescription, "calibrate_floor");
  dominant_plane_detection::SourceArguments arguments;
  std::string output;
  dominant_plane_detection::declareSource(app, arguments, true);
  app.add_option("--output", output, "file that is written")->required()->type_name("FILE");
  return dominant_plane_detection::runTool(
      app, argc, argv, [&] { return dominant_plane_detection::run(arguments, output); });
}
