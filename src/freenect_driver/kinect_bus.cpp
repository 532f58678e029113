#include "freenect_driver/kinect_bus.h"

#include <algorithm>
#include <stdexcept>

#include "freenect_driver/optional_functions.h"

namespace dominant_plane_detection::freenect_driver {
namespace {

/// Later models report a serial number of zeros.
std::string serialNumber(const char* text) {
  const std::string serial = text != nullptr ? text : "";
  const bool zeros = std::all_of(serial.begin(), serial.end(), [](char c) { return c == '0'; });
  return zeros ? "" : serial;
}

}  // namespace

std::string KinectId::uri() const {
  return kScheme + (serial.empty() ? "bus-" + std::to_string(index) : serial);
}

freenect_frame_mode findDepthMode() {
  for (int i = 0; i < freenect_get_depth_mode_count(); ++i) {
    const freenect_frame_mode mode = freenect_get_depth_mode(i);
    if (mode.depth_format == FREENECT_DEPTH_11BIT && mode.is_valid != 0) return mode;
  }
  return {};
}

freenect_frame_mode findVideoMode(freenect_video_format format, freenect_resolution resolution) {
  for (int i = 0; i < freenect_get_video_mode_count(); ++i) {
    const freenect_frame_mode mode = freenect_get_video_mode(i);
    const bool same = mode.video_format == format && mode.resolution == resolution;
    if (same && mode.is_valid != 0) return mode;
  }
  return {};
}

KinectBus::KinectBus() {
  const int status = freenect_init(&context_, nullptr);
  if (status < 0) {
    throw std::runtime_error("libfreenect does not start, error " + std::to_string(status));
  }
  freenect_set_log_level(context_, FREENECT_LOG_ERROR);
}

KinectBus::~KinectBus() { freenect_shutdown(context_); }

int KinectBus::count() const { return std::max(freenect_num_devices(context_), 0); }

std::vector<KinectId> KinectBus::list() const {
  std::vector<KinectId> kinects;
  const OptionalFunctions& functions = optionalFunctions();
  if (functions.list_device_attributes != nullptr && functions.free_device_attributes != nullptr) {
    freenect_device_attributes* first = nullptr;
    if (functions.list_device_attributes(context_, &first) < 0) return {};
    for (const auto* one = first; one != nullptr; one = one->next) {
      kinects.push_back({serialNumber(one->camera_serial), static_cast<int>(kinects.size())});
    }
    if (first != nullptr) functions.free_device_attributes(first);
    return kinects;
  }
  for (int i = 0; i < count(); ++i) kinects.push_back({"", i});
  return kinects;
}

}  // namespace dominant_plane_detection::freenect_driver
