// Renders a scene to a bag or to a folder of images, with the truth beside it.

#include <unistd.h>

#include <boost/timer/progress_display.hpp>
#include <iostream>
#include <optional>

#include "recording_writer.h"
#include "synthetic/scene.h"
#include "tool_main.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDescription =
    "Renders a scene as a depth camera would see it, along the scene's camera path.\n\n"
    "A bag gets /camera/depth/image_raw (16UC1, mm), /camera/depth/camera_info,\n"
    "/camera/rgb/image_raw (rgb8, the same pixels) and /truth/plane; a folder gets depth/, rgb/,\n"
    "mask/ (255 = true ground) and reference.csv.\n\n"
    "Example:\n"
    "  render_scene rubbish_bin.yaml --output drive.bag\n";

struct Options {
  std::string scene;
  std::string output;
  double rate = 30.0;
  double duration = 0.0;
  std::string sensor;
  bool no_noise = false;
  std::uint32_t seed = 0;
};

void declare(CLI::App& app, Options& options) {
  app.add_option("scene", options.scene, "scene description")->required()->type_name("SCENE.yaml");
  app.add_option("--output", options.output, "a bag when it ends in .bag, otherwise a folder")
      ->required()
      ->type_name("FILE.bag|DIR");
  app.add_option("--rate", options.rate, "images per second")
      ->check(CLI::Range(0.1, 1000.0))
      ->capture_default_str();
  app.add_option("--duration", options.duration, "[s] stop after this time; 0: the whole path")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--sensor", options.sensor,
                 "whose noise the readings have; otherwise that of the scene")
      ->check(CLI::IsMember({"kinect", "realsense", "independent"}));
  app.add_flag("--no-noise", options.no_noise, "true depth in mm instead of a sensor's");
  app.add_option("--seed", options.seed, "of the noise")->capture_default_str();
}

SensorNoise noiseFor(const Scene& scene, const Options& options) {
  if (options.no_noise) return SensorNoise::none();
  return options.sensor.empty() ? scene.noise : SensorNoise::named(options.sensor);
}

int run(const Options& options) {
  const Scene scene = loadScene(options.scene);
  const SensorNoise noise = noiseFor(scene, options);
  const bool bag = options.output.size() > 4 &&
                   options.output.compare(options.output.size() - 4, 4, ".bag") == 0;
  const auto writer =
      bag ? openBagWriter(options.output, scene.camera) : openFolderWriter(options.output);
  const double duration = options.duration > 0.0 ? options.duration : scene.path.duration();
  const auto frames = static_cast<std::uint32_t>(duration * options.rate) + 1;
  std::optional<boost::timer::progress_display> progress;
  if (isatty(STDERR_FILENO) != 0) progress.emplace(frames, std::cerr);
  const Renderer renderer(scene);
  for (std::uint32_t i = 0; i < frames; ++i) {
    RecordedFrame frame;
    frame.number = i;
    frame.time = i / options.rate;
    frame.rendering = renderer.render(scene.path.at(frame.time).pose(), {noise.shadows, true});
    frame.depth = senseDepth(frame.rendering, noise, options.seed + i);
    writer->write(frame);
    if (progress) ++*progress;
  }
  std::cout << frames << " images in " << options.output << '\n';
  return 0;
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  CLI::App app(dominant_plane_detection::kDescription, "render_scene");
  dominant_plane_detection::Options options;
  dominant_plane_detection::declare(app, options);
  return dominant_plane_detection::runTool(app, argc, argv,
                                           [&] { return dominant_plane_detection::run(options); });
}
