#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace openni {
class Device;
}

namespace dominant_plane_detection {

/// A camera that OpenNI2 knows of.
struct CameraDescription {
  std::string uri;
  std::string vendor;
  std::string name;
  std::string serial;  ///< empty where the device does not tell, or somebody else has it open
};

/// One line with all that is known, for users.
std::string describe(const CameraDescription& camera);

/// OpenNI2 in this process, shared by all who use it. Opening and closing of devices go through it,
/// one at a time: OpenNI2 does not guard them.
class OpenNi2Runtime {
 public:
  /// Told in OpenNI2's thread that devices came or went; must not call back.
  /// @param gone URI of the device that went, empty when one came.
  using Listener = std::function<void(const std::string& gone)>;

  /// Starts OpenNI2, or shares it.
  /// @throw std::runtime_error when it does not start, or when another OpenNI2 than ours has been
  /// loaded into the process, which would not know our drivers.
  static std::shared_ptr<OpenNi2Runtime> instance();
  ~OpenNi2Runtime();
  OpenNi2Runtime(const OpenNi2Runtime&) = delete;
  OpenNi2Runtime& operator=(const OpenNi2Runtime&) = delete;

  /// @return all devices that are plugged in. Opens each for a moment to read its serial number.
  std::vector<CameraDescription> cameras();

  /// @return an open device.
  /// @throw std::runtime_error with OpenNI2's reason.
  std::unique_ptr<openni::Device> open(const std::string& uri);
  void close(std::unique_ptr<openni::Device> device);

  /// @return a number for `removeListener`.
  int addListener(Listener listener);
  /// Waits for a listener that is being told.
  void removeListener(int number);

 private:
  class Events;

  OpenNi2Runtime();
  std::string serialOf(const std::string& uri);
  void tell(const std::string& gone);

  std::mutex opening_;  ///< held while a device is opened or closed; `mutex_` may be taken within
  std::mutex mutex_;    ///< of what follows
  std::map<std::string, std::string> serials_;  ///< by URI
  std::map<int, Listener> listeners_;
  int next_listener_ = 0;
  std::unique_ptr<Events> events_;
};

/// @return the serial number of an open device, empty where it does not tell.
std::string serialNumber(const openni::Device& device);

/// To be called between stopping and destroying the streams of a recording. OpenNI2's player goes
/// through them in a thread of its own and without a lock: at once after one was stopped, and each
/// 10 ms while none plays. One that is destroyed meanwhile ends the process, about once in 150
/// times without this pause.
void letPlayerRest();

/// @return the text of OpenNI2's last error on one line.
std::string lastOpenNi2Error();

}  // namespace dominant_plane_detection
