// Prints how near the detector's plane is to one true surface in scenes that have several, beside a
// fit to that surface's true pixels; and what the other surface is called.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <vector>

#include "support/scoring.h"
#include "support/surface_figures.h"

namespace dominant_plane_detection {
namespace {

constexpr double kDegree = 0.017453292519943295;
/// [px] A surface that is asked for by its height.
constexpr std::size_t kAskedFor = 640 * 480 / 20;

struct Errors {
  std::vector<double> angle, height;  ///< [deg], [mm]

  void add(const SurfaceError& error) {
    angle.push_back(error.angle / kDegree);
    height.push_back(1e3 * error.height);
  }
};

/// Asks for each surface by a height range of a third of the step on either side.
struct Asked {
  int all = 0, found = 0;

  void ask(DominantPlaneDetector& detector, const SurfaceImage& image) {
    for (std::size_t i = 0; i < image.surfaces().size(); ++i) {
      const std::optional<double> step = image.stepFrom(i);
      if (!step || image.readings(i) < kAskedFor) continue;
      const double height = -image.surfaces()[i].offset;
      Prior prior;
      prior.height_range = Prior::HeightRange{height - *step / 3.0, height + *step / 3.0};
      const Detection& detection = detector.detect(image.view(), image.camera(), prior);
      ++all;
      found += detection.found() && image.nearest(detection.normal, detection.distance) == i;
    }
  }
};

void printPlanes(FloorKind kind, ErrorKind error, const Parameters& parameters, int scenes) {
  DominantPlaneDetector detector(parameters);
  Errors ours, fits;
  Asked asked;
  int missing = 0;
  for (int i = 1; i <= scenes; ++i) {
    const auto seed = static_cast<std::uint32_t>(i);
    const SurfaceImage image(surfaceScene(kind, seed), error, seed);
    const Detection& detection = detector.detect(image.view(), image.camera());
    if (detection.found()) {
      const std::size_t surface = image.nearest(detection.normal, detection.distance);
      ours.add(image.error(detection.normal, detection.distance, surface));
      if (const auto fit = image.fitError(surface)) fits.add(*fit);
    } else {
      ++missing;
    }
    asked.ask(detector, image);
  }
  std::printf("| %s | %d | %.2f, %.2f | %.1f, %.1f | %.2f, %.2f | %.1f, %.1f | %d of %d |\n",
              floorKindName(kind), missing, quantile(ours.angle, 0.5), quantile(ours.angle, 0.95),
              quantile(ours.height, 0.5), quantile(ours.height, 0.95), quantile(fits.angle, 0.5),
              quantile(fits.angle, 0.95), quantile(fits.height, 0.5), quantile(fits.height, 0.95),
              asked.found, asked.all);
  std::fflush(stdout);
}

void printLabels(const LabelCase& which, ErrorKind error, int images) {
  int found = 0, told = 0, wrong = 0;
  double right = 0.0, ground = 0.0;
  for (int i = 1; i <= images; ++i) {
    const LabelFigures figures =
        labelFigures(which, static_cast<double>(i) / images, error, static_cast<std::uint32_t>(i));
    found += figures.found;
    told += figures.told();
    right += figures.right / images;
    ground += figures.ground / images;
    wrong += figures.false_drop_off >= 30;
  }
  std::printf("| %s | %d | %d | %.2f | %.2f | %d |\n", which.name, found, told, right, ground,
              wrong);
  std::fflush(stdout);
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  namespace dpd = dominant_plane_detection;
  CLI::App app("Planes and labels where a floor has steps and ramps", "ground_surfaces");
  int scenes = 60;
  bool defaults = false;
  app.add_option("--scenes", scenes, "of each kind")->capture_default_str();
  app.add_flag("--defaults", defaults, "the default profile, not that of the error");
  CLI11_PARSE(app, argc, argv);
  const char* names[] = {"smooth errors of 0.8 sigma(z), 20 to 40 px", "as a Kinect's",
                         "as a RealSense's"};
  for (const auto error :
       {dpd::ErrorKind::kSmooth, dpd::ErrorKind::kKinect, dpd::ErrorKind::kRealsense}) {
    std::printf("\n%s\n\n", names[static_cast<std::size_t>(error)]);
    std::printf(
        "| kind | missing | angle [deg] | height [mm] | fit: angle | fit: height | asked for |\n"
        "|---|---|---|---|---|---|---|\n");
    const dpd::Parameters parameters = defaults ? dpd::Parameters() : dpd::parametersOf(error);
    for (const dpd::FloorKind kind : dpd::kFloorKinds) {
      dpd::printPlanes(kind, error, parameters, scenes);
    }
    std::printf(
        "\n| other surface | found | told | right | ground | floor called drop-off |\n"
        "|---|---|---|---|---|---|\n");
    for (const dpd::LabelCase& which : dpd::labelCases()) {
      dpd::printLabels(which, error, scenes);
    }
  }
}
