#include "openni2/runtime.h"

#include <OpenNI.h>
#include <dlfcn.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace dominant_plane_detection {
namespace {

/// @return the folder that a function's library was loaded from.
std::filesystem::path folderOf(const void* function) {
  Dl_info info{};
  if (dladdr(function, &info) == 0) return {};
  return std::filesystem::absolute(info.dli_fname).parent_path().lexically_normal();
}

/// A library is found by its name: who loads an OpenNI2 first decides for the whole process.
void requireOurLibrary() {
  const auto loaded = folderOf(reinterpret_cast<const void*>(&oniInitialize));
  if (std::filesystem::exists(loaded / "OpenNI2/Drivers/libVirtualKinect.so.0")) return;
  throw std::runtime_error(
      "expected OpenNI2 from the folder dominant_plane_detection/openni2, but " + loaded.string() +
      "/libOpenNI2.so.0 is loaded already, which does not know this package's drivers: load the "
      "driver into its manager before nodelets that use another OpenNI2, or into a manager of its "
      "own");
}

}  // namespace

void letPlayerRest() { std::this_thread::sleep_for(std::chrono::milliseconds(100)); }

std::string lastOpenNi2Error() {
  std::string text = openni::OpenNI::getExtendedError();
  std::string line;
  for (const char c : text) {
    const bool blank = c == '\n' || c == '\t' || c == ' ';
    if (!blank) line += c;
    if (blank && !line.empty() && line.back() != ' ') line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

std::string describe(const CameraDescription& camera) {
  return camera.uri + " (" + camera.vendor + " " + camera.name + ", serial number " +
         (camera.serial.empty() ? "unknown" : camera.serial) + ")";
}

std::string serialNumber(const openni::Device& device) {
  std::array<char, 256> text{};
  int size = static_cast<int>(text.size());
  if (device.getProperty(ONI_DEVICE_PROPERTY_SERIAL_NUMBER, text.data(), &size) !=
      openni::STATUS_OK) {
    return "";
  }
  text.back() = '\0';
  return text.data();
}

class OpenNi2Runtime::Events : public openni::OpenNI::DeviceConnectedListener,
                               public openni::OpenNI::DeviceDisconnectedListener {
 public:
  explicit Events(OpenNi2Runtime& runtime) : runtime_(runtime) {
    openni::OpenNI::addDeviceConnectedListener(this);
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }
  ~Events() {
    openni::OpenNI::removeDeviceConnectedListener(this);
    openni::OpenNI::removeDeviceDisconnectedListener(this);
  }
  Events(const Events&) = delete;
  Events& operator=(const Events&) = delete;

  void onDeviceConnected(const openni::DeviceInfo* /*info*/) override { runtime_.tell(""); }
  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    runtime_.tell(info->getUri());
  }

 private:
  OpenNi2Runtime& runtime_;
};

std::shared_ptr<OpenNi2Runtime> OpenNi2Runtime::instance() {
  static std::mutex mutex;
  static std::weak_ptr<OpenNi2Runtime> shared;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<OpenNi2Runtime> runtime = shared.lock();
  if (!runtime) {
    runtime.reset(new OpenNi2Runtime);
    shared = runtime;
  }
  return runtime;
}

OpenNi2Runtime::OpenNi2Runtime() {
  requireOurLibrary();
  if (openni::OpenNI::initialize() != openni::STATUS_OK) {
    throw std::runtime_error("OpenNI2 does not start: " + lastOpenNi2Error());
  }
  events_ = std::make_unique<Events>(*this);
}

OpenNi2Runtime::~OpenNi2Runtime() {
  events_.reset();
  openni::OpenNI::shutdown();
}

std::vector<CameraDescription> OpenNi2Runtime::cameras() {
  openni::Array<openni::DeviceInfo> infos;
  openni::OpenNI::enumerateDevices(&infos);
  std::vector<CameraDescription> cameras;
  for (int i = 0; i < infos.getSize(); ++i) {
    const openni::DeviceInfo& info = infos[i];
    cameras.push_back({info.getUri(), info.getVendor(), info.getName(), serialOf(info.getUri())});
  }
  return cameras;
}

std::string OpenNi2Runtime::serialOf(const std::string& uri) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = serials_.find(uri);
    if (known != serials_.end()) return known->second;
  }
  const std::lock_guard<std::mutex> opening(opening_);
  openni::Device device;
  if (device.open(uri.c_str()) != openni::STATUS_OK) return "";
  const std::string serial = serialNumber(device);
  device.close();
  const std::lock_guard<std::mutex> lock(mutex_);
  return serials_[uri] = serial;
}

std::unique_ptr<openni::Device> OpenNi2Runtime::open(const std::string& uri) {
  const std::lock_guard<std::mutex> lock(opening_);
  auto device = std::make_unique<openni::Device>();
  if (device->open(uri.c_str()) != openni::STATUS_OK) {
    throw std::runtime_error("cannot open " + uri + ": " + lastOpenNi2Error());
  }
  return device;
}

void OpenNi2Runtime::close(std::unique_ptr<openni::Device> device) {
  const std::lock_guard<std::mutex> lock(opening_);
  device->close();
}

int OpenNi2Runtime::addListener(Listener listener) {
  const std::lock_guard<std::mutex> lock(mutex_);
  listeners_[++next_listener_] = std::move(listener);
  return next_listener_;
}

void OpenNi2Runtime::removeListener(int number) {
  const std::lock_guard<std::mutex> lock(mutex_);
  listeners_.erase(number);
}

void OpenNi2Runtime::tell(const std::string& gone) {
  const std::lock_guard<std::mutex> lock(mutex_);
  serials_.erase(gone);  // what is plugged in there next may be another one
  for (const auto& [number, listener] : listeners_) listener(gone);
}

}  // namespace dominant_plane_detection
