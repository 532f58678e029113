// An OpenNI2 driver plug-in that plays scenes as a Kinect would see them. OpenNI2 hands it the URIs
// that no other driver knows; see virtual_uri.h for what they may say.

#include <dlfcn.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <thread>

#include "virtual_kinect/scheduler.h"
#include "virtual_kinect/virtual_device.h"
#include "virtual_kinect/virtual_uri.h"

namespace dominant_plane_detection::virtual_kinect {
namespace {

/// @return the folder that the package installs its scenes in, from where this plug-in lies.
std::string scenesFolder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&scenesFolder), &info) == 0) return ".";
  // lib/dominant_plane_detection/openni2/OpenNI2/Drivers/ of a prefix
  const auto folder = std::filesystem::absolute(info.dli_fname).parent_path();
  return (folder / "../../../../../share/dominant_plane_detection/scenes")
      .lexically_normal()
      .string();
}

OniDeviceInfo deviceInfo(const std::string& uri) {
  OniDeviceInfo info{};
  std::strncpy(info.uri, uri.c_str(), ONI_MAX_STR - 1);
  std::strncpy(info.vendor, "dominant_plane_detection", ONI_MAX_STR - 1);
  std::strncpy(info.name, "Virtual Kinect", ONI_MAX_STR - 1);
  return info;
}

}  // namespace

class VirtualDriver : public oni::driver::DriverBase {
 public:
  explicit VirtualDriver(OniDriverServices* services)
      : DriverBase(services), scenes_(scenesFolder()), scheduler_(std::make_unique<Scheduler>()) {}

  OniStatus tryDevice(const char* uri) override {
    if (std::strncmp(uri, kScheme, std::strlen(kScheme)) != 0) return ONI_STATUS_ERROR;
    try {
      Plug plug;
      plug.uri = parseUri(uri, scenes_);
      plug.scene = loadScene(plug.uri.scene);
      if (!plug.uri.sensor.empty()) plug.scene.noise = SensorNoise::named(plug.uri.sensor);
      if (!plug.uri.noise) plug.scene.noise = SensorNoise::none();
      plug.replug = plug.uri.replug;
      const std::lock_guard<std::mutex> lock(mutex_);
      plugs_[uri] = plug;
    } catch (const std::exception& error) {
      explain(error.what());
      return ONI_STATUS_ERROR;
    }
    const OniDeviceInfo info = deviceInfo(uri);
    deviceConnected(&info);
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* /*mode*/) override {
    const std::string name = uri;
    std::this_thread::sleep_for(std::chrono::duration<double>(slownessOf(name)));
    const std::lock_guard<std::mutex> lock(mutex_);
    Plug& plug = plugs_.at(name);
    VirtualDevice::Driver driver;
    driver.unplug_after = [this, name](double delay) {
      scheduler_->after(delay, [this, name] { unplug(name); });
    };
    driver.replug_after = [this, name](double delay) {
      const std::lock_guard<std::mutex> guard(mutex_);
      plugs_.at(name).replug = delay;
    };
    driver.explain = [this](const std::string& text) { explain(text); };
    plug.device = new VirtualDevice({plug.uri, plug.scene}, std::move(driver));
    scheduleFaults(name, plug);
    return plug.device;
  }

  void deviceClose(oni::driver::DeviceBase* device) override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (auto& [uri, plug] : plugs_) {
        if (plug.device == device) plug.device = nullptr;
      }
    }
    delete device;
  }

  void shutdown() override { scheduler_.reset(); }

 private:
  /// Where a device can be plugged in.
  struct Plug {
    VirtualUri uri;
    Scene scene;
    double replug = -1.0;             ///< [s] after unplugging, < 0: never
    bool faults_scheduled = false;    ///< those of the URI happen once
    VirtualDevice* device = nullptr;  ///< while it is open
  };

  void explain(const std::string& text) {
    getServices().errorLoggerAppend("Virtual Kinect: %s", text.c_str());
  }

  /// @return [s] that opening the device takes.
  double slownessOf(const std::string& uri) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return plugs_.at(uri).uri.slow;
  }

  void scheduleFaults(const std::string& uri, Plug& plug) {
    if (plug.faults_scheduled) return;
    plug.faults_scheduled = true;
    if (plug.uri.unplug >= 0.0) {
      scheduler_->after(plug.uri.unplug, [this, uri] { unplug(uri); });
    }
    if (plug.uri.stall >= 0.0) {
      scheduler_->after(plug.uri.stall, [this, uri] {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (plugs_.at(uri).device != nullptr) plugs_.at(uri).device->stall();
      });
    }
  }

  void unplug(const std::string& uri) {
    double replug = -1.0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      Plug& plug = plugs_.at(uri);
      if (plug.device != nullptr) plug.device->unplug();
      plug.device = nullptr;
      replug = plug.replug;
    }
    const OniDeviceInfo info = deviceInfo(uri);
    deviceDisconnected(&info);
    if (replug >= 0.0) scheduler_->after(replug, [this, info] { deviceConnected(&info); });
  }

  std::string scenes_;
  std::mutex mutex_;
  std::map<std::string, Plug> plugs_;  ///< by URI
  std::unique_ptr<Scheduler> scheduler_;
};

}  // namespace dominant_plane_detection::virtual_kinect

ONI_EXPORT_DRIVER(dominant_plane_detection::virtual_kinect::VirtualDriver)
