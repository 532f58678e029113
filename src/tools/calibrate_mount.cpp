// Height, pitch and roll of a mounted camera from its view of free floor: from recordings, or from
// a detection nodelet that runs.

#include <ros/ros.h>

#include <cstdio>
#include <iostream>

#include "calibration/mount_estimate.h"
#include "dominant_plane_detection/dominant_plane_detector.h"
#include "inputs.h"
#include "ros/mount_service.h"
#include "source_arguments.h"
#include "tool_main.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDescription =
    "Measures how a camera is mounted: its height, pitch and roll over free, level floor, with "
    "the\n"
    "camera at rest, and the static transform to put into a launch file.\n\n"
    "Examples:\n"
    "  calibrate_mount --node /camera/plane_detection     a camera that runs\n"
    "  calibrate_mount floor.bag                          a recording\n";

struct Options {
  SourceArguments source;
  std::string node = "/camera/plane_detection";
  int frames = 100;
};

void print(const CalibrateMount::Response& r) {
  constexpr double kDegrees = 57.29578;
  std::printf("height %.4f m +- %.5f m\n", r.height, r.height_error);
  std::printf("pitch  %.3f deg +- %.4f deg (%.5f rad, down)\n", kDegrees * r.pitch,
              kDegrees * r.pitch_error, r.pitch);
  std::printf("roll   %.3f deg +- %.4f deg (%.5f rad, to the right)\n", kDegrees * r.roll,
              kDegrees * r.roll_error, r.roll);
  std::printf("+-: how well that repeats; the camera's own error over the floor comes on top\n");
  std::printf("from %u images; of camera_link:\n%s\n", r.frames, r.launch.c_str());
}

int measureRecordings(const Options& options) {
  DominantPlaneDetector detector(options.source.readParameters());
  const Inputs inputs = openInputs(options.source.inputs, options.source.readSourceOptions());
  MountEstimate estimate;
  const bool all = forEachFrame(inputs, "calibrate_mount", [&](const Frame& frame) {
    estimate.add(detector.detect(frame.depth, frame.camera), frame.frame_id);
  });
  print(toResponse(estimate.mount()));
  return all ? 0 : 1;
}

int askNode(const Options& options) {
  int argc = 0;
  ros::init(argc, nullptr, "calibrate_mount",
            ros::init_options::AnonymousName | ros::init_options::NoSigintHandler);
  if (!ros::master::check()) {
    throw std::runtime_error("there is no ROS master: expected a running camera, or recordings");
  }
  const std::string service = options.node + "/calibrate_mount";
  if (!ros::service::waitForService(service, ros::Duration(5.0))) {
    throw std::runtime_error("there is no service " + service +
                             ": expected a detection nodelet, named by --node");
  }
  CalibrateMount call;
  call.request.frames = static_cast<std::uint32_t>(options.frames);
  if (!ros::service::call(service, call)) throw std::runtime_error(service + " does not answer");
  if (!call.response.success) throw std::runtime_error(call.response.message);
  print(call.response);
  return 0;
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  using namespace dominant_plane_detection;
  CLI::App app(kDescription, "calibrate_mount");
  Options options;
  declareSource(app, options.source, false);
  app.add_option("--node", options.node, "detection nodelet to ask, without recordings")
      ->capture_default_str();
  app.add_option("--frames", options.frames, "images to average, without recordings")
      ->check(CLI::Range(10, 10000))
      ->capture_default_str();
  return runTool(app, argc, argv, [&] {
    return options.source.inputs.empty() ? askNode(options) : measureRecordings(options);
  });
}
