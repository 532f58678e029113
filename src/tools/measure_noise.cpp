// A sensor's profile from a recording of a floor.

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "calibration/floor_noise.h"
#include "dominant_plane_detection/dominant_plane_detector.h"
#include "inputs.h"
#include "source_arguments.h"
#include "tool_main.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDescription =
    "Measures how a depth camera errs on a floor, and prints a profile for --sensor. The "
    "recording\n"
    "should show much floor, from near to far, with little on it: a minute of slow driving.\n\n"
    "Examples:\n"
    "  measure_noise drive.bag > my_camera.yaml\n"
    "  detect_planes drive.bag --sensor my_camera.yaml --output result\n";

/// For people, beside the profile.
void printTable(std::size_t images, const std::vector<FloorNoiseFigures>& figures) {
  std::fprintf(stderr,
               "%zu images; heights of floor readings over the plane [mm]:\n"
               "  depth [m]   readings      rms  pixel to pixel  local  smooth\n",
               images);
  for (const FloorNoiseFigures& f : figures) {
    if (f.readings == 0) continue;
    std::fprintf(stderr, "  %.1f to %.1f  %9zu  %7.2f  %14.2f  %5.2f  %6.2f\n", f.nearest,
                 f.farthest, f.readings, 1e3 * f.height, 1e3 * f.neighbour, 1e3 * f.local,
                 1e3 * f.smooth);
  }
}

void printProfile(std::size_t images, const std::vector<FloorNoiseFigures>& figures) {
  const NoiseModel local = FloorNoise::localError(figures);
  const NoiseModel smooth = FloorNoise::smoothError(figures);
  std::printf(
      "# Measured by measure_noise on %zu images.\n\n"
      "# [m], [1/m] rms of small blocks over the ground about them\n"
      "local_error_constant: %.2g\nlocal_error_quadratic: %.2g\n\n"
      "# [m], [1/m] rms of 112 x 112 px of a floor over its plane\n"
      "smooth_error_constant: %.2g\nsmooth_error_quadratic: %.2g\n\n"
      "# What a large part of the image shares no plane shows: wide_error_constant and\n"
      "# wide_error_quadratic stay those of --params, by default a Kinect's.\n",
      images, std::max(local.constant, 1e-5), local.quadratic, std::max(smooth.constant, 1e-5),
      smooth.quadratic);
}

int run(const SourceArguments& arguments) {
  DominantPlaneDetector detector(arguments.readParameters());
  const Inputs inputs = openInputs(arguments.inputs, arguments.readSourceOptions());
  FloorNoise noise;
  const bool all = forEachFrame(inputs, "measure_noise", [&](const Frame& frame) {
    noise.add(frame.depth, frame.camera, detector.detect(frame.depth, frame.camera));
  });
  if (noise.images() == 0) throw std::runtime_error("No image shows a ground plane.");
  const std::vector<FloorNoiseFigures> figures = noise.figures();
  printTable(noise.images(), figures);
  printProfile(noise.images(), figures);
  return all ? 0 : 1;
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  CLI::App app(dominant_plane_detection::kDescription, "measure_noise");
  dominant_plane_detection::SourceArguments arguments;
  dominant_plane_detection::declareSource(app, arguments, true);
  return dominant_plane_detection::runTool(
      app, argc, argv, [&] { return dominant_plane_detection::run(arguments); });
}
