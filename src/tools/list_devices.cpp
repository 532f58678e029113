// Lists the cameras that the driver can open, with what they can do.

#include <iostream>

#include "openni2/camera_choice.h"
#include "openni2/camera_device.h"
#include "tool_main.h"

namespace dominant_plane_detection {
namespace {

constexpr const char* kDescription =
    "Lists the cameras that OpenNI2 finds, as the driver's device_id takes them, with the modes "
    "of\n"
    "their streams. A virtual Kinect or a recording is in no list: name it to see its modes.\n\n"
    "Examples:\n"
    "  list_devices\n"
    "  list_devices virtual://rubbish_bin\n"
    "  list_devices /absolute/path/recording.oni\n";

void show(const std::shared_ptr<OpenNi2Runtime>& runtime, const std::string& number,
          const std::string& uri) {
  const CameraDevice camera(runtime, uri, [](StreamKind, const SensorFrame&) {});
  std::cout << number << describe(camera.description()) << '\n';
  for (const StreamKind kind : kAllStreams) {
    if (!camera.has(kind)) continue;
    const SensorStream& stream = camera.stream(kind);
    std::cout << "    " << toString(kind) << ": " << toString(stream.modes()) << ", field of view "
              << stream.horizontalFieldOfView() << " rad\n";
    if (kind == StreamKind::kDepth && !stream.modes(true).empty()) {
      std::cout << "    raw disparity: " << toString(stream.modes(true)) << '\n';
    }
  }
  if (camera.hasAccelerometer()) std::cout << "    accelerometer\n";
  if (camera.hasMotor()) std::cout << "    motor and light\n";
  if (camera.hasExposure()) std::cout << "    exposure can be set\n";
  if (camera.hasGain()) std::cout << "    gain can be set\n";
}

int run(const std::vector<std::string>& ids) {
  const auto runtime = OpenNi2Runtime::instance();
  const auto cameras = runtime->cameras();
  if (ids.empty()) {
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      show(runtime, "#" + std::to_string(i + 1) + " ", cameras[i].uri);
    }
    if (cameras.empty()) std::cout << "no camera is connected\n";
  }
  int status = 0;
  for (const std::string& id : ids) {
    const CameraChoice choice = chooseCamera(id, cameras);
    try {
      if (choice.uri.empty()) throw std::runtime_error(choice.error);
      show(runtime, "", choice.uri);
    } catch (const std::exception& error) {
      std::cerr << "list_devices: " << error.what() << '\n';
      status = 1;
    }
  }
  return status;
}

}  // namespace
}  // namespace dominant_plane_detection

int main(int argc, char** argv) {
  CLI::App app(dominant_plane_detection::kDescription, "list_devices");
  std::vector<std::string> ids;
  app.add_option("device_id", ids, "cameras to show; all that are connected without")
      ->type_name("ID");
  return dominant_plane_detection::runTool(app, argc, argv,
                                           [&] { return dominant_plane_detection::run(ids); });
}
