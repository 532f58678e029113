// An OpenNI2 driver plug-in for the Kinect v1, which OpenNI2 itself does not know, on libfreenect.

#include <pthread.h>

#include <chrono>
#include <condition_variable>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "freenect_driver/kinect_bus.h"
#include "freenect_driver/kinect_device.h"

namespace dominant_plane_detection::freenect_driver {
namespace {

constexpr std::chrono::seconds kLookAgain{1};
constexpr int kLooks = 5;

OniDeviceInfo deviceInfo(const std::string& uri) {
  OniDeviceInfo info{};
  std::strncpy(info.uri, uri.c_str(), ONI_MAX_STR - 1);
  std::strncpy(info.vendor, "Microsoft", ONI_MAX_STR - 1);
  std::strncpy(info.name, "Kinect v1", ONI_MAX_STR - 1);
  info.usbVendorId = 0x045e;
  info.usbProductId = 0x02ae;
  return info;
}

}  // namespace

class KinectDriver : public oni::driver::DriverBase {
 public:
  explicit KinectDriver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed,
                       void* cookie) override {
    DriverBase::initialize(connected, disconnected, state_changed, cookie);
    try {
      bus_ = std::make_unique<KinectBus>();
    } catch (const std::runtime_error& error) {
      explain(error.what());
      return ONI_STATUS_ERROR;
    }
    look();
    watch_ = std::thread([this] { watch(); });
    return ONI_STATUS_OK;
  }

  /// Lets a Kinect be opened that was plugged in a moment ago.
  OniStatus tryDevice(const char* uri) override {
    if (std::strncmp(uri, kScheme, std::strlen(kScheme)) != 0) return ONI_STATUS_ERROR;
    for (const KinectId& id : listBus()) {
      if (id.uri() != uri) continue;
      appear(id);
      return ONI_STATUS_OK;
    }
    return ONI_STATUS_ERROR;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* /*mode*/) override {
    KinectId id;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const auto known = kinects_.find(uri);
      if (known == kinects_.end()) return nullptr;
      id = known->second;
    }
    const auto lost = [this, name = id.uri()] {
      const std::lock_guard<std::mutex> lock(mutex_);
      lost_.insert(name);
      changed_.notify_all();
    };
    try {
      return new KinectDevice(id, lost, [this](const std::string& text) { explain(text); });
    } catch (const std::runtime_error& error) {
      explain(error.what());
      return nullptr;
    }
  }

  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }

  void shutdown() override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ending_ = true;
    }
    changed_.notify_all();
    if (watch_.joinable()) watch_.join();
    bus_.reset();
  }

 private:
  void explain(const std::string& text) {
    getServices().errorLoggerAppend("Kinect v1: %s", text.c_str());
  }

  // OpenNI2 calls a driver with a lock held that it takes as well when it is told of a device: none
  // of our own may be held while it is told.

  /// Tells OpenNI2 of Kinects that come and go, from a thread that never holds up a device.
  void watch() {
    pthread_setname_np(pthread_self(), "kinect_watch");
    std::unique_lock<std::mutex> lock(mutex_);
    while (!ending_) {
      changed_.wait_for(lock, kLookAgain, [this] { return ending_ || !lost_.empty(); });
      if (ending_) return;
      const std::set<std::string> lost = std::exchange(lost_, {});
      const int known = static_cast<int>(kinects_.size());
      lock.unlock();
      for (const std::string& uri : lost) disappear(uri);
      // What was lost may be there again already, but not before it was said to be gone.
      if (worthALook(known) || !lost.empty()) look();
      lock.lock();
    }
  }

  /// A Kinect that was just plugged in may not be open to this user yet; one that never will be is
  /// not asked for ever.
  bool worthALook(int known) {
    int count = 0;
    {
      const std::lock_guard<std::mutex> lock(bus_mutex_);
      count = bus_->count();
    }
    if (std::exchange(count_, count) != count) looks_left_ = kLooks;
    return known != count && looks_left_-- > 0;
  }

  std::vector<KinectId> listBus() {
    const std::lock_guard<std::mutex> lock(bus_mutex_);
    return bus_->list();
  }

  void look() {
    const std::vector<KinectId> present = listBus();
    std::set<std::string> gone;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (const auto& [uri, id] : kinects_) gone.insert(uri);
    }
    for (const KinectId& id : present) gone.erase(id.uri());
    for (const std::string& uri : gone) disappear(uri);
    for (const KinectId& id : present) appear(id);
  }

  void appear(const KinectId& id) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (ending_ || !kinects_.emplace(id.uri(), id).second) return;
    }
    const OniDeviceInfo info = deviceInfo(id.uri());
    deviceConnected(&info);
  }

  void disappear(const std::string& uri) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (ending_ || kinects_.erase(uri) == 0) return;
    }
    const OniDeviceInfo info = deviceInfo(uri);
    deviceDisconnected(&info);
  }

  std::mutex bus_mutex_;  ///< of `bus_`
  std::unique_ptr<KinectBus> bus_;
  int count_ = 0;            ///< [#] of Kinects at the last look of the watch
  int looks_left_ = kLooks;  ///< [#] until the watch gives up to find them all
  std::mutex looking_;       ///< one look at a time; `mutex_` may be taken within
  std::mutex mutex_;         ///< of what follows
  std::condition_variable changed_;
  std::map<std::string, KinectId> kinects_;  ///< by URI, as OpenNI2 knows them
  std::set<std::string> lost_;               ///< URIs whose transfers failed
  bool ending_ = false;
  std::thread watch_;
};

}  // namespace dominant_plane_detection::freenect_driver

ONI_EXPORT_DRIVER(dominant_plane_detection::freenect_driver::KinectDriver)
